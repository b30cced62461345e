// When to stop handing out work: the user's interrupt, the batch system's signal, or the end of the time
// granted. Tiles in flight are finished; a second interrupt ends the program at once.
#pragma once

#include <chrono>
#include <optional>

namespace hopscotch {

/// While one lives, SIGINT and SIGTERM only raise a flag. One at a time.
class stop_condition {
  public:
    /// \param walltime  seconds from now after which no tile may still be in flight
    explicit stop_condition(std::optional<double> walltime = std::nullopt);
    ~stop_condition();
    stop_condition(const stop_condition&) = delete;
    stop_condition& operator=(const stop_condition&) = delete;

    /// A signal has come.
    bool is_interrupted() const;

    /// No work of about `seconds` should be begun any more.
    bool is_due(double seconds = 0.0) const;

    double elapsed() const;  // seconds since the beginning

  private:
    std::chrono::steady_clock::time_point begin_;
    std::optional<double> walltime_;
};

}  // namespace hopscotch
