// Words for special points and ends.
#include "analysis/continuation/branch.hpp"

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

std::string text_of(const end_of_branch& end) {
    switch (end.why) {
        case branch_end::range:
            return "end of the range";
        case branch_end::failure:
            return "ends: " + end.detail;
        case branch_end::border:
            return "ends at a border: " + end.detail;
        case branch_end::root:
            return "ends in a square root at " + end.detail;
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

}  // namespace hopscotch
