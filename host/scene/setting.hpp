// The tree of values that a scene file and the command line give, each with the line it came from.
// Readers of scenes see only this tree, never the TOML library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hopscotch {

/// A table, a list or a plain value; an empty table until it is given one.
struct setting {
    using list = std::vector<setting>;
    using table = std::map<std::string, setting, std::less<>>;

    std::variant<table, list, std::string, std::int64_t, double, bool> value;
    int line = 0;  // 0 = given on the command line

    bool is_table() const { return std::holds_alternative<table>(value); }
    bool is_list() const { return std::holds_alternative<list>(value); }

    /// The entry of that name, or null where this is no table or has none.
    const setting* find(std::string_view name) const;

    /// As it would be written in TOML, cut short where long.
    std::string written() const;
};

/// A parsed scene file: its tree and what messages need to name it.
struct document {
    std::string file;
    std::string text;
    setting root;

    std::string place(int line) const;  // "scene.toml:14" or "command line"
};

/// Parses TOML text. `file` only names it in messages.
/// \error scene_error with the parser's reason at its line
document parse_document(std::string text, std::string file);

/// Reads and parses a TOML file.
/// \error scene_error where it cannot be read
document load_document(const std::filesystem::path& file);

/// Applies `key=value` of the command line: `grid.axis.0.cells=512`, `model.options.spring=air`.
/// Values are TOML; what is not TOML is taken as text. Tables on the way are made where they are
/// missing; an axis index equal to the number of axes adds one.
/// \error scene_error with the place "command line"
void apply_overrides(document& scene, std::span<const std::string> overrides);

}  // namespace hopscotch
