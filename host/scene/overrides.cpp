// `key=value` of the command line, laid over the tree of the scene file before it is validated.
#include "host/scene/error.hpp"
#include "host/scene/setting.hpp"

#include <charconv>

namespace hopscotch {
namespace {

constexpr const char* command_line = "command line";

[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& why,
                         const std::string& suggestion) {
    throw scene_error({command_line, key, value, why, suggestion});
}

/// "grid.axis[0].cells" and "grid.axis.0.cells" both give grid, axis, 0, cells.
std::vector<std::string> split(std::string_view key) {
    std::vector<std::string> parts(1);
    for (const char letter : key) {
        if (letter == '.' || letter == '[') {
            parts.emplace_back();
        } else if (letter != ']') {
            parts.back() += letter;
        }
    }
    return parts;
}

void forget_lines(setting& value) {
    value.line = 0;
    if (auto* table = std::get_if<setting::table>(&value.value)) {
        for (auto& [name, entry] : *table) forget_lines(entry);
    } else if (auto* list = std::get_if<setting::list>(&value.value)) {
        for (setting& entry : *list) forget_lines(entry);
    }
}

setting parse_value(const std::string& text) {
    setting result;
    try {
        const document parsed = parse_document("value = " + text + "\n", command_line);
        const auto& table = std::get<setting::table>(parsed.root.value);
        if (table.size() == 1)
            result = table.begin()->second;
        else
            result.value = text;
    } catch (const scene_error&) {
        result.value = text;  // a bare word, as the shell leaves it
    }
    forget_lines(result);
    return result;
}

setting& entry_of_list(setting::list& list, const std::string& part, const std::string& key,
                       const std::string& value) {
    std::size_t index = 0;
    const auto [end, failure] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (failure != std::errc{} || end != part.data() + part.size()) {
        refuse(key, value, "\"" + part + "\" is no index of a list", "a number from 0");
    }
    if (index > list.size()) {
        refuse(key, value, "there are only " + std::to_string(list.size()) + " entries",
               "an index from 0 to " + std::to_string(list.size()));
    }
    if (index == list.size()) list.emplace_back();
    return list[index];
}

/// A table that was only just made for `grid.axis` in `grid.axis.0.cells` is a list after all.
void make_list_for_index(setting& parent, const std::string& part) {
    const bool is_index = part.find_first_not_of("0123456789") == std::string::npos;
    const auto* table = std::get_if<setting::table>(&parent.value);
    if (is_index && table != nullptr && table->empty()) parent.value = setting::list{};
}

setting& entry_of(setting& parent, const std::string& part, const std::string& key,
                  const std::string& value) {
    if (part.empty()) refuse(key, value, "an empty name in the key", "section.key=value");
    make_list_for_index(parent, part);
    if (auto* table = std::get_if<setting::table>(&parent.value)) {
        return table->try_emplace(part).first->second;
    }
    if (auto* list = std::get_if<setting::list>(&parent.value)) {
        return entry_of_list(*list, part, key, value);
    }
    refuse(key, value, "\"" + part + "\" lies inside a plain value", "");
}

}  // namespace

void apply_overrides(document& scene, std::span<const std::string> overrides) {
    for (const std::string& text : overrides) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0) {
            refuse(text, "", "an override has the form key=value", "grid.axis.0.cells=512");
        }
        const std::string key = text.substr(0, equals);
        const std::string value = text.substr(equals + 1);
        setting* target = &scene.root;
        for (const std::string& part : split(key)) target = &entry_of(*target, part, key, value);
        *target = parse_value(value);
    }
}

}  // namespace hopscotch
