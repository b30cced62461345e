# Compiler flags shared by every target. Bit identity asks for no contraction and for x86-64-v3 as the
# least processor; kernels are optimised in every build type.
add_library(hopscotch_flags INTERFACE)
target_compile_options(hopscotch_flags INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off -march=x86-64-v3>)

# masks combine with & | ! on bool as well as on packs, hence no -Wparentheses
set(HOPSCOTCH_WARNINGS -Wall -Wextra -Wshadow -Wconversion -Wno-maybe-uninitialized -Wno-parentheses
    -Wno-missing-field-initializers)
if(HOPSCOTCH_WARNINGS_AS_ERRORS)
    list(APPEND HOPSCOTCH_WARNINGS -Werror)
endif()
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:${HOPSCOTCH_WARNINGS}>")

if(HOPSCOTCH_SANITIZE)
    add_compile_options(-fsanitize=${HOPSCOTCH_SANITIZE} -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${HOPSCOTCH_SANITIZE})
endif()

include(HopscotchTargets)
