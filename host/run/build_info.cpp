// Version, revision, compiler.
#include "host/run/build_info.hpp"

#ifndef HOPSCOTCH_VERSION
#define HOPSCOTCH_VERSION "0.1.0"
#endif
#ifndef HOPSCOTCH_REVISION
#define HOPSCOTCH_REVISION "unknown"
#endif
#ifndef HOPSCOTCH_FLAGS
#define HOPSCOTCH_FLAGS "unknown"
#endif

namespace hopscotch {

const build_info& this_build() {
#ifdef __clang__
    static const build_info info{HOPSCOTCH_VERSION, HOPSCOTCH_REVISION, "Clang " __clang_version__,
                                 HOPSCOTCH_FLAGS};
#else
    static const build_info info{HOPSCOTCH_VERSION, HOPSCOTCH_REVISION, "GCC " __VERSION__,
                                 HOPSCOTCH_FLAGS};
#endif
    return info;
}

}  // namespace hopscotch
