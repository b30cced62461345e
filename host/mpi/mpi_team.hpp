// The ranks of an MPI job as a team. Agreement on errors is part of it: an exception on one rank
// ends the work on all, and rank 0 says which rank met what.
#pragma once

#include "host/mpi/mpi_session.hpp"
#include "host/run/team.hpp"

namespace hopscotch {

class mpi_team : public team {
public:
    explicit mpi_team(mpi_session& session) : session_(session) {}

    int rank() const override { return session_.rank(); }
    int size() const override { return session_.size(); }
    int default_threads() const override;
    std::unique_ptr<tile_queue> open_queue(std::vector<std::uint64_t> tiles,
                                           progress_display show) override;
    std::unique_ptr<shared_counters> open_counters(std::size_t n) override;
    void together(const std::function<void()>& work) override;
    std::vector<std::uint64_t> from_first(std::vector<std::uint64_t> numbers) override;
    std::vector<double> from_all(double number) override;
    std::string who_differs(const std::string& text) override;
    void leave(const std::exception& error) noexcept override;

private:
    std::string from(int rank, std::string text);
    int lowest(int number);

    mpi_session& session_;
    bool is_agreed_ = false;  // all ranks know that the run has failed
};

}  // namespace hopscotch
