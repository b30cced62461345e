// When to stop handing out work: the user's interrupt, the batch system's signal, or the end of the
// time granted. Tiles in flight are finished; a second interrupt ends the program at once.
#pragma once

#include <chrono>
#include <exception>
#include <optional>

namespace hopscotch {

/// Ends work that cannot be finished in good time; whoever began it says how to go on.
struct interruption : std::exception {
    const char* what() const noexcept override { return "interrupted"; }
};

/// While one lives, SIGINT, SIGTERM and SIGUSR1 only raise a flag. They may be nested (a sweep and
/// its maps). SIGUSR1 is what batch systems are asked to send before the end of a job's time;
/// launchers pass it on to all ranks, some of them more than once, so that it may come again.
class stop_condition {
public:
    /// \param walltime  seconds from now after which no tile may still be in flight
    explicit stop_condition(std::optional<double> walltime = std::nullopt);
    ~stop_condition();
    stop_condition(const stop_condition&) = delete;
    stop_condition& operator=(const stop_condition&) = delete;

    /// A signal has come. Long work outside the tiles asks now and then, and throws `interruption`.
    static bool is_interrupted();

    /// No work of about `seconds` should be begun any more.
    bool is_due(double seconds = 0.0) const;

    double elapsed() const;  // seconds since the beginning

private:
    std::chrono::steady_clock::time_point begin_;
    std::optional<double> walltime_;
};

}  // namespace hopscotch
