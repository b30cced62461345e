// Typed access to one table of a scene: every key must be known, every value of its type, and every
// message names file, line, key and value.
#pragma once

#include "host/scene/error.hpp"
#include "host/scene/setting.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

class table_reader {
public:
    /// \param path   dotted name of the table, "" for the whole scene
    /// \param table  null where the scene has no such table: then every key is missing
    /// \param line   where to point when a key is missing
    table_reader(const document& scene, std::string path, const setting* table, int line);

    /// The whole scene.
    static table_reader root(const document& scene);

    /// A table inside this one; absent tables read as empty.
    table_reader table(std::string_view key) const;
    /// The tables of an array of tables, in order.
    std::vector<table_reader> tables(std::string_view key) const;

    /// Every key must be one of these.
    /// \error scene_error naming the key, with the closest of `known`
    void expect_keys(std::span<const std::string_view> known, std::string_view what = "key") const;
    void expect_keys(std::initializer_list<std::string_view> known) const;

    bool has(std::string_view key) const { return entry(key) != nullptr; }
    std::vector<std::string> keys() const;

    /// Where the key stands (the table where it is missing), for later messages.
    std::string place(std::string_view key) const;
    const std::string& path() const { return path_; }

    std::optional<std::string> text(std::string_view key) const;
    std::optional<bool> flag(std::string_view key) const;
    /// A number that is not NaN; integers count as numbers.
    std::optional<double> number(std::string_view key) const;
    std::optional<std::int64_t> whole(
        std::string_view key, std::int64_t least,
        std::int64_t most = std::numeric_limits<std::int64_t>::max()) const;
    /// A list of numbers, none of them NaN.
    std::optional<std::vector<double>> numbers(std::string_view key) const;
    std::optional<std::vector<std::string>> texts(std::string_view key) const;
    std::optional<std::vector<std::int64_t>> wholes(std::string_view key, std::int64_t least) const;

    /// A mistake in the value of `key`.
    [[noreturn]] void refuse(std::string_view key, const std::string& why,
                             const std::string& suggestion = "") const;
    /// A mistake of the table itself, or the absence of `key`.
    [[noreturn]] void missing(std::string_view key, const std::string& why,
                              const std::string& suggestion = "") const;

private:
    const setting* entry(std::string_view key) const;
    std::string dotted(std::string_view key) const;

    const document* scene_;
    std::string path_;
    const setting* table_;
    int line_;
};

}  // namespace hopscotch
