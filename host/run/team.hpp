// The processes that compute one map together: one alone, or the ranks of an MPI job. What a run
// needs of them and nothing else; a run without MPI goes through the same lines with a team of one.
#pragma once

#include "host/run/shared_counters.hpp"
#include "host/run/tile_queue.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace hopscotch {

/// Another rank has failed. Its text is complete on rank 0, which tells the user, and empty on all
/// others.
class rank_failure : public std::runtime_error {
public:
    rank_failure(int code, const std::string& text) : std::runtime_error(text), code_(code) {}
    int code() const { return code_; }  // of the program's exit

private:
    int code_;
};

/// Members marked collective are called by all ranks in the same order.
class team {
public:
    team() = default;
    virtual ~team() = default;
    team(const team&) = delete;
    team& operator=(const team&) = delete;

    virtual int rank() const = 0;
    virtual int size() const = 0;
    bool is_first() const { return rank() == 0; }

    /// Threads of this rank where the user has not chosen: its share of the processors it may use.
    virtual int default_threads() const = 0;

    /// A queue of these tiles, the same on every rank. Rank 0 shows the progress. Collective.
    virtual std::unique_ptr<tile_queue> open_queue(std::vector<std::uint64_t> tiles,
                                                   progress_display show) = 0;

    /// Counters that begin at 0. Collective, and so is their end.
    virtual std::unique_ptr<shared_counters> open_counters(std::size_t n) = 0;

    /// True where other processes may have put tiles into the run that this one owns.
    virtual bool has_helpers() const { return size() > 1; }

    /// Runs `work`; what one rank throws ends it on all. Collective.
    /// \error  rank 0's own exception, or rank_failure; `interruption` where that was thrown
    virtual void together(const std::function<void()>& work) = 0;

    /// Rank 0's numbers, on all ranks. Collective.
    virtual std::vector<std::uint64_t> from_first(std::vector<std::uint64_t> numbers) = 0;

    /// Every rank's number, in their order. Collective.
    virtual std::vector<double> from_all(double number) = 0;

    /// The ranks (with their hosts) whose text differs from rank 0's; empty where all agree.
    /// Collective.
    virtual std::string who_differs(const std::string& text) = 0;

    /// An exception leaves the run. Where the other ranks do not know of it, ends them too.
    virtual void leave(const std::exception& error) noexcept = 0;
};

/// One process.
class team_of_one : public team {
public:
    int rank() const override { return 0; }
    int size() const override { return 1; }
    int default_threads() const override;
    std::unique_ptr<tile_queue> open_queue(std::vector<std::uint64_t> tiles,
                                           progress_display show) override;
    std::unique_ptr<shared_counters> open_counters(std::size_t n) override;
    void together(const std::function<void()>& work) override { work(); }
    std::vector<std::uint64_t> from_first(std::vector<std::uint64_t> numbers) override {
        return numbers;
    }
    std::vector<double> from_all(double number) override { return {number}; }
    std::string who_differs(const std::string&) override { return {}; }
    void leave(const std::exception&) noexcept override {}
};

/// Share of the ranks' time in which they had nothing left to draw, while others still computed.
/// \param seconds  after which each rank has found nothing more, >= 0
double idle_share(const std::vector<double>& seconds);

}  // namespace hopscotch
