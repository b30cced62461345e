// Words for special points and ends.
#include "analysis/continuation/branch.hpp"

#include <fmt/format.h>

namespace hopscotch {

std::string_view name_of(special_kind kind) {
    switch (kind) {
        case special_kind::fold:
            return "fold";
        case special_kind::flip:
            return "flip";
        case special_kind::neimark_sacker:
            return "neimark-sacker";
        case special_kind::branch_point:
            return "branch point";
        case special_kind::border:
            return "border collision";
        case special_kind::birth:
            return "birth";
    }
    return "";
}

namespace {

std::string reason_of(const end_of_branch& end) {
    switch (end.why) {
        case branch_end::range:
            return "end of the range";
        case branch_end::failure:
            return "ends: " + end.detail;
        case branch_end::border:
            return "ends at a border: " + end.detail;
        case branch_end::root:
            return "ends in a root of the map";
        case branch_end::closed:
            return "closed";
        case branch_end::birth:
            return "shrinks to half the period";
        case branch_end::lost:
            return "lost";
        case branch_end::budget:
            return "budget of points spent";
        case branch_end::start:
            return "begins at its parent";
    }
    return "";
}

}  // namespace

std::string text_of(const end_of_branch& end) {
    if (!end.place) return reason_of(end);
    return fmt::format("{}, at {:.14g} +- {:.1g}", reason_of(end), end.place->numbers[0],
                       end.place->errors[0]);
}

}  // namespace hopscotch
