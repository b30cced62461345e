// The kinds of question a scene may ask, one row each: what it needs and what it stores by default.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace hopscotch {

/// A number in [question] that only this kind of question knows.
struct question_number {
    std::string_view name;
    double standard;
    double least;
    bool is_whole;
};

struct question_kind {
    std::string_view name;
    std::string_view meaning;
    bool has_labels;  // orbits run until a certificate or trap labels them
    bool is_map;      // `run` computes it; else another command answers it
    std::uint32_t standard_returns;
    std::span<const question_number> numbers;
    std::span<const std::string_view> standard_layers;  // "state" stands for all state columns
    std::uint64_t standard_audit_cells = 1000;
    bool has_classes = true;  // few different answers, with boundaries between them
};

std::span<const question_kind> question_kinds();

/// The kind of that name, or null.
const question_kind* find_question(std::string_view name);

}  // namespace hopscotch
