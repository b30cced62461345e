// Errors to exit codes.
#include "host/run/exit_code.hpp"

#include "host/run/device_error.hpp"
#include "host/run/stop_condition.hpp"
#include "host/run/team.hpp"
#include "host/scene/error.hpp"
#include "host/store/store_error.hpp"

namespace hopscotch {

int exit_code_of(const std::exception& error) {
    if (const auto* other = dynamic_cast<const rank_failure*>(&error)) return other->code();
    if (dynamic_cast<const scene_error*>(&error) != nullptr) return exit_input;
    if (dynamic_cast<const store_error*>(&error) != nullptr) return exit_store;
    if (dynamic_cast<const device_error*>(&error) != nullptr) return exit_device;
    if (dynamic_cast<const interruption*>(&error) != nullptr) return exit_resumable;
    return exit_failed;
}

}  // namespace hopscotch
