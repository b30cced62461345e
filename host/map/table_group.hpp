// Tables that belong to a map beside its layers: a group of a file with arrays of numbers over
// named dimensions. Plain data, shared by those who fill it, the store and readers.
#pragma once

#include "host/map/layout.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

struct table_dimension {
    std::string name;  // other than that of any table of the group
    std::uint64_t size = 0;
};

struct number_table {
    std::string name;
    std::string long_name;
    number_type type = number_type::float64;
    std::vector<table_dimension> dimensions;  // the last one is the fastest; none of size 0
    std::vector<double> values;               // representable in the type
};

struct table_group {
    std::string name;  // as a path: "/traps"
    attribute_list attributes;
    std::vector<number_table> tables;

    /// The attribute of that name, or null.
    const std::string* attribute(std::string_view wanted) const {
        for (const auto& [key, text] : attributes) {
            if (key == wanted) return &text;
        }
        return nullptr;
    }
    /// The table of that name, or null.
    const number_table* table(std::string_view wanted) const {
        for (const number_table& each : tables) {
            if (each.name == wanted) return &each;
        }
        return nullptr;
    }
};

}  // namespace hopscotch
