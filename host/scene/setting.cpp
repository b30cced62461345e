// Looking into the tree of settings and writing its values back as TOML for messages.
#include "host/scene/setting.hpp"

#include <fmt/format.h>

namespace hopscotch {

const setting* setting::find(std::string_view name) const {
    const auto* entries = std::get_if<table>(&value);
    if (entries == nullptr) return nullptr;
    const auto found = entries->find(name);
    return found == entries->end() ? nullptr : &found->second;
}

namespace {

struct writer {
    std::string operator()(const setting::table&) const { return "{...}"; }
    std::string operator()(const setting::list& entries) const {
        std::string text = "[";
        for (const setting& entry : entries) {
            if (text.size() > 1) text += ", ";
            if (text.size() > 60) return text + "...]";
            text += entry.written();
        }
        return text + "]";
    }
    std::string operator()(const std::string& text) const {
        std::string shown = text.size() > 60 ? text.substr(0, 57) + "..." : text;
        for (char& letter : shown) {
            if (static_cast<unsigned char>(letter) < ' ') letter = ' ';  // messages are one line
        }
        return "\"" + shown + "\"";
    }
    std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
};

}  // namespace

std::string setting::written() const { return std::visit(writer{}, value); }

std::string document::place(int line) const {
    return line == 0 ? "command line" : file + ":" + std::to_string(line);
}

}  // namespace hopscotch
