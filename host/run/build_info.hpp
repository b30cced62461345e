// What this program was built from and how: stored in every map and printed by `version`.
#pragma once

#include <string>
#include <string_view>

namespace hopscotch {

/// The build system sets HOPSCOTCH_VERSION, HOPSCOTCH_REVISION and HOPSCOTCH_FLAGS for this unit.
struct build_info {
    std::string_view version;
    std::string_view revision;  // of the repository; "unknown" outside one
    std::string compiler;
    std::string_view flags;
};

const build_info& this_build();

}  // namespace hopscotch
