// Takes locks by flock where the file system knows it, else by process number.
#include "host/store/run_lock.hpp"

#include "host/store/lock_holder.hpp"
#include "host/store/store_error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

namespace hopscotch {

namespace {

constexpr const char* whole_name = "lock";
constexpr const char* shard_prefix = "lock.shard_";

std::filesystem::path lock_path(const std::filesystem::path& directory, const shard& part) {
    if (part.is_whole()) return directory / whole_name;
    return directory /
           (shard_prefix + std::to_string(part.index + 1) + "_of_" + std::to_string(part.count));
}

/// True where the name still leads to the open file: its last holder may have removed it meanwhile.
bool is_in_place(int descriptor, const std::filesystem::path& file) {
    struct stat opened {};
    struct stat named {};
    return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
           opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

/// \param lock_error  of flock on the file, 0 where it succeeded
/// \return            whether the holder lives on this host, as far as one can know
bool lives_here(const lock_holder& other, int lock_error) {
    if (lock_error == 0) return false;
    if (lock_error == EWOULDBLOCK) return true;
    // Where the file system knows no locks, the process number is all there is.
    return other.process > 0 && other.is_on_this_host() &&
           ::kill(static_cast<pid_t>(other.process), 0) == 0;
}

bool may_live_elsewhere(const lock_holder& other) {
    return other.process > 0 && !other.is_on_this_host() && !other.is_earlier_start_of_this_job();
}

store_error held_by(const std::filesystem::path& file, const lock_holder& other) {
    const std::string place = file.parent_path().string();
    if (other.process == 0 || other.is_on_this_host()) {
        return {place, "another run works here: " + other.words(), "wait for it or stop it first"};
    }
    const std::string ask = other.job == "-" ? "" : "squeue -j " + other.job + " tells; ";
    return {place, "held by " + other.words() + ", last sign of life " + age_of(file) + " ago",
            ask + "if that run is dead, remove " + file.string()};
}

}  // namespace

bool is_shard_lock(const std::filesystem::path& file) {
    return file.filename().string().starts_with(shard_prefix);
}

run_lock::run_lock(const std::filesystem::path& directory, const shard& part)
    : file_(lock_path(directory, part)) {
    take();
    try {
        require_no_other(part);
    } catch (...) {
        give_back();
        throw;
    }
}

void run_lock::take() {
    int descriptor = -1;
    int lock_error = 0;
    do {
        if (descriptor >= 0) ::close(descriptor);
        descriptor = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0) {
            throw system_error_at(file_.string(), "the lock cannot be written", errno);
        }
        lock_error = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    } while (lock_error == 0 && !is_in_place(descriptor, file_));

    const lock_holder other = lock_holder::read(descriptor);
    if (lives_here(other, lock_error) || may_live_elsewhere(other)) {
        ::close(descriptor);
        throw held_by(file_, other);
    }
    if (other.process > 0) {
        note_ = file_.parent_path().string() + ": took over from " + other.words() +
                ", which runs no longer";
    }
    const std::string text = lock_holder::this_process().line();
    if (::ftruncate(descriptor, 0) != 0 ||
        ::pwrite(descriptor, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
        const int error = errno;
        ::close(descriptor);
        throw system_error_at(file_.string(), "the lock cannot be written", error);
    }
    descriptor_ = descriptor;
}

/// Everyone takes his own lock first and then looks at the others', so that of two runs at least
/// one sees the other.
void run_lock::require_no_other(const shard& part) const {
    std::error_code error;
    for (std::filesystem::directory_iterator each(file_.parent_path(), error), end;
         !error && each != end; each.increment(error)) {
        const std::filesystem::path& file = each->path();
        const bool excludes = part.is_whole() ? is_shard_lock(file) : file.filename() == whole_name;
        if (!excludes) continue;
        const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
        if (descriptor < 0) continue;  // just given back
        const int lock_error = ::flock(descriptor, LOCK_SH | LOCK_NB) == 0 ? 0 : errno;
        const lock_holder other = lock_holder::read(descriptor);
        ::close(descriptor);
        if (lives_here(other, lock_error) || may_live_elsewhere(other)) throw held_by(file, other);
    }
}

void run_lock::touch() const { ::futimens(descriptor_, nullptr); }

void run_lock::give_back() {
    if (descriptor_ < 0) return;
    ::unlink(file_.c_str());
    ::close(std::exchange(descriptor_, -1));
}

run_lock::~run_lock() { give_back(); }

}  // namespace hopscotch
