#include "host/store/run_lock.hpp"

#include "host/store/store_error.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>

namespace hopscotch {

namespace {

struct holder {
    long process = 0;
    std::string host;
    std::string since;

    std::string words() const {
        return "process " + std::to_string(process) + " on " + host + ", started " + since;
    }
};

std::string host_name() {
    char name[256] = "unknown";
    ::gethostname(name, sizeof name - 1);
    return name;
}

std::string now() {
    const std::time_t time = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&time, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

/// Who wrote the lock file; process 0 where it is empty.
holder read_holder(int descriptor) {
    std::array<char, 512> text{};
    if (::pread(descriptor, text.data(), text.size() - 1, 0) <= 0) return {};
    char host[256] = "";
    char since[64] = "";
    holder result;
    if (std::sscanf(text.data(), "process %ld host %255s since %63s", &result.process, host,
                    since) == 3) {
        result.host = host;
        result.since = since;
    }
    return result;
}

void write_holder(int descriptor, const std::filesystem::path& file) {
    const std::string text =
        "process " + std::to_string(::getpid()) + " host " + host_name() + " since " + now() + "\n";
    if (::ftruncate(descriptor, 0) != 0 ||
        ::pwrite(descriptor, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
        throw system_error_at(file.string(), "the lock cannot be written", errno);
    }
}

/// True where the name still leads to the open file: its last holder may have removed it meanwhile.
bool is_in_place(int descriptor, const std::filesystem::path& file) {
    struct stat opened {};
    struct stat named {};
    return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
           opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

store_error held_by(const std::filesystem::path& file, const holder& other) {
    return {file.parent_path().string(), "another run works here: " + other.words(),
            "wait for it or stop it first"};
}

}  // namespace

run_lock::run_lock(const std::filesystem::path& directory) : file_(directory / "lock") {
    int descriptor = -1;
    int lock_status = -1;
    int lock_error = 0;
    do {
        if (descriptor >= 0) ::close(descriptor);
        descriptor = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0) {
            throw system_error_at(file_.string(), "the lock cannot be written", errno);
        }
        lock_status = ::flock(descriptor, LOCK_EX | LOCK_NB);
        lock_error = errno;
    } while (lock_status == 0 && !is_in_place(descriptor, file_));

    const holder other = read_holder(descriptor);
    const bool has_kernel_lock = lock_status == 0;
    const bool is_same_host = other.host == host_name();
    // Where the file system knows no locks, the process number is all there is.
    const bool may_be_alive =
        has_kernel_lock
            ? false
            : lock_error == EWOULDBLOCK || (other.process > 0 && is_same_host &&
                                            ::kill(static_cast<pid_t>(other.process), 0) == 0);
    const bool is_elsewhere = other.process > 0 && !is_same_host;
    if (may_be_alive || is_elsewhere) {
        ::close(descriptor);
        if (!is_elsewhere) throw held_by(file_, other);
        throw store_error(directory.string(), "held by " + other.words(),
                          "if that run is dead, remove " + file_.string());
    }
    if (other.process > 0) {
        note_ = directory.string() + ": took over from " + other.words() + ", which runs no longer";
    }
    descriptor_ = descriptor;
    write_holder(descriptor, file_);
}

run_lock::~run_lock() {
    if (descriptor_ < 0) return;
    ::unlink(file_.c_str());
    ::close(descriptor_);
}

}  // namespace hopscotch
