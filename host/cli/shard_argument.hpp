// `--shard I/N` as users type it, counted from 1.
#pragma once

#include "host/map/shard.hpp"

#include <string>
#include <string_view>

namespace hopscotch {

/// \error usage_error
shard shard_of(std::string_view text);

/// "2/8"
std::string text_of(const shard& part);

}  // namespace hopscotch
