// From TOML text to the tree of settings: the only file that sees the TOML library.
#include "host/scene/error.hpp"
#include "host/scene/setting.hpp"

#include <toml++/toml.h>

#include <fstream>
#include <sstream>

namespace hopscotch {
namespace {

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

setting convert(const toml::node& node, const std::string& file) {
    setting result;
    result.line = line_of(node);
    if (const auto* table = node.as_table()) {
        setting::table entries;
        for (const auto& [key, entry] : *table) {
            entries.emplace(std::string(key.str()), convert(entry, file));
        }
        result.value = std::move(entries);
    } else if (const auto* array = node.as_array()) {
        setting::list entries;
        for (const auto& entry : *array) entries.push_back(convert(entry, file));
        result.value = std::move(entries);
    } else if (const auto* text = node.as_string()) {
        result.value = text->get();
    } else if (const auto* integer = node.as_integer()) {
        result.value = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
        result.value = number->get();
    } else if (const auto* flag = node.as_boolean()) {
        result.value = flag->get();
    } else {
        throw scene_error({file + ":" + std::to_string(result.line), "a date or time", "",
                           "scenes hold no dates", "put it in quotes"});
    }
    return result;
}

}  // namespace

document parse_document(std::string text, std::string file) {
    document result;
    result.file = std::move(file);
    result.text = std::move(text);
    try {
        result.root = convert(toml::parse(result.text, result.file), result.file);
    } catch (const toml::parse_error& error) {
        const std::string place = result.file + ":" + std::to_string(error.source().begin.line);
        throw scene_error({place, "not TOML", "", std::string(error.description()), ""});
    }
    return result;
}

document load_document(const std::filesystem::path& file) {
    std::error_code failure;
    if (!std::filesystem::exists(file, failure) || std::filesystem::is_directory(file, failure)) {
        throw scene_error({file.string(), "scene", "", "no such file", ""});
    }
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) throw scene_error({file.string(), "scene", "", "the file cannot be read", ""});
    return parse_document(std::move(text).str(), file.string());
}

}  // namespace hopscotch
