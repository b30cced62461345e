// Signals and time limits.
#include "host/run/stop_condition.hpp"

#include <csignal>
#include <mutex>

namespace hopscotch {
namespace {

volatile std::sig_atomic_t has_signal = 0;
std::mutex mutex;
int n_alive = 0;  // a sweep and its maps

void raise_flag(int signal) {
    has_signal = 1;
    std::signal(signal, SIG_DFL);
}

void raise_flag_again(int) { has_signal = 1; }

}  // namespace

stop_condition::stop_condition(std::optional<double> walltime)
    : begin_(std::chrono::steady_clock::now()), walltime_(walltime) {
    const std::lock_guard guard(mutex);
    if (n_alive++ > 0) return;
    has_signal = 0;
    std::signal(SIGINT, raise_flag);
    std::signal(SIGTERM, raise_flag);
    std::signal(SIGUSR1, raise_flag_again);
}

stop_condition::~stop_condition() {
    const std::lock_guard guard(mutex);
    if (--n_alive > 0) return;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGUSR1, SIG_IGN);  // the answer is being written
}

bool stop_condition::is_interrupted() { return has_signal != 0; }

bool stop_condition::is_due(double seconds) const {
    if (is_interrupted()) return true;
    return walltime_ && elapsed() + seconds >= *walltime_;
}

double stop_condition::elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

}  // namespace hopscotch
