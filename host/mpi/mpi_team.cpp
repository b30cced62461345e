// Collective operations, all of them non-blocking so that waiting costs no processor time.
#include "host/mpi/mpi_team.hpp"

#include "host/mpi/mpi_counters.hpp"
#include "host/mpi/mpi_queue.hpp"
#include "host/run/exit_code.hpp"
#include "host/run/stop_condition.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

namespace hopscotch {
namespace {

std::string this_rank(int rank) {
    char host[256] = "unknown";
    ::gethostname(host, sizeof host - 1);
    return fmt::format("rank {} on {}", rank, host);
}

/// How an exception ends the program, and its text.
std::pair<int, std::string> end_by(const std::exception_ptr& failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const std::exception& error) {
        return {exit_code_of(error), error.what()};
    }
}

}  // namespace

/// Ranks of one node that may use the same processors divide them (mpirun without binding);
/// otherwise a rank has those it is bound to.
int mpi_team::default_threads() const {
    cpu_set_t mine;
    CPU_ZERO(&mine);
    sched_getaffinity(0, sizeof mine, &mine);
    std::vector<cpu_set_t> all(static_cast<std::size_t>(session_.size_of_node()));
    const std::lock_guard guard(session_.turn());
    MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, session_.node());
    const auto n_sharing = std::count_if(
        all.begin(), all.end(), [&](const cpu_set_t& other) { return CPU_EQUAL(&other, &mine); });
    return std::max(1, CPU_COUNT(&mine) / static_cast<int>(n_sharing));
}

std::unique_ptr<tile_queue> mpi_team::open_queue(std::vector<std::uint64_t> tiles,
                                                 progress_display show) {
    return std::make_unique<mpi_queue>(session_, std::move(tiles), std::move(show));
}

std::unique_ptr<shared_counters> mpi_team::open_counters(std::size_t n) {
    return std::make_unique<mpi_counters>(session_, n);
}

void mpi_team::together(const std::function<void()>& work) {
    std::exception_ptr failure;
    try {
        work();
    } catch (const std::exception&) {
        failure = std::current_exception();
    }
    const int first = lowest(failure ? rank() : size());
    if (first == size()) return;
    is_agreed_ = true;
    const auto [code, text] = failure ? end_by(failure) : std::pair<int, std::string>{};
    const auto code_of_first = std::stoi(from(first, std::to_string(code)));
    const std::string words = from(first, fmt::format("{}: {}", this_rank(rank()), text));
    if (code_of_first == exit_resumable) throw interruption();
    if (first == 0 && rank() == 0) std::rethrow_exception(failure);
    throw rank_failure(code_of_first, is_first() ? words : "");
}

std::vector<std::uint64_t> mpi_team::from_first(std::vector<std::uint64_t> numbers) {
    std::uint64_t n = numbers.size();
    MPI_Request request = MPI_REQUEST_NULL;
    {
        const std::lock_guard guard(session_.turn());
        MPI_Ibcast(&n, 1, MPI_UINT64_T, 0, session_.all(), &request);
    }
    session_.wait(request);
    numbers.resize(n);
    {
        const std::lock_guard guard(session_.turn());
        MPI_Ibcast(numbers.data(), static_cast<int>(n), MPI_UINT64_T, 0, session_.all(), &request);
    }
    session_.wait(request);
    return numbers;
}

std::vector<double> mpi_team::from_all(double number) {
    std::vector<double> all(static_cast<std::size_t>(size()));
    MPI_Request request = MPI_REQUEST_NULL;
    {
        const std::lock_guard guard(session_.turn());
        MPI_Iallgather(&number, 1, MPI_DOUBLE, all.data(), 1, MPI_DOUBLE, session_.all(), &request);
    }
    session_.wait(request);
    return all;
}

std::string mpi_team::who_differs(const std::string& text) {
    const int first = lowest(from(0, text) == text ? size() : rank());
    return first == size() ? "" : from(first, this_rank(rank()));
}

void mpi_team::leave(const std::exception& error) noexcept {
    if (is_agreed_) return;
    std::fprintf(stderr, "hopscotch: %s: %s\n", this_rank(rank()).c_str(), error.what());
    std::fflush(nullptr);
    MPI_Abort(session_.all(), exit_code_of(error));
}

/// A text of one rank, on all ranks.
std::string mpi_team::from(int rank, std::string text) {
    auto length = static_cast<int>(text.size());
    MPI_Request request = MPI_REQUEST_NULL;
    {
        const std::lock_guard guard(session_.turn());
        MPI_Ibcast(&length, 1, MPI_INT, rank, session_.all(), &request);
    }
    session_.wait(request);
    text.resize(static_cast<std::size_t>(length));
    {
        const std::lock_guard guard(session_.turn());
        MPI_Ibcast(text.data(), length, MPI_CHAR, rank, session_.all(), &request);
    }
    session_.wait(request);
    return text;
}

int mpi_team::lowest(int number) {
    int result = number;
    MPI_Request request = MPI_REQUEST_NULL;
    {
        const std::lock_guard guard(session_.turn());
        MPI_Iallreduce(&number, &result, 1, MPI_INT, MPI_MIN, session_.all(), &request);
    }
    session_.wait(request);
    return result;
}

}  // namespace hopscotch
