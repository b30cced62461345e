#include "host/store/atomic_file.hpp"

#include "host/store/store_error.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <utility>

namespace hopscotch {

namespace {

/// A file descriptor that closes itself.
class descriptor {
public:
    descriptor(const std::filesystem::path& path, int flags)
        : id_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
    ~descriptor() {
        if (id_ >= 0) ::close(id_);
    }
    descriptor(const descriptor&) = delete;
    descriptor& operator=(const descriptor&) = delete;

    int id() const { return id_; }
    bool is_open() const { return id_ >= 0; }
    bool close() { return ::close(std::exchange(id_, -1)) == 0; }

private:
    int id_;
};

/// 0, or the error number of the write that failed.
int write_all(int id, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(id, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return 0;
}

}  // namespace

std::filesystem::path partial_name(const std::filesystem::path& path) {
    static std::atomic<unsigned> counter{0};
    char host[256] = "host";
    ::gethostname(host, sizeof host - 1);
    std::filesystem::path partial = path;
    partial += std::string(partial_mark) + host + "-" + std::to_string(::getpid()) + "-" +
               std::to_string(counter++);
    return partial;
}

void write_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const std::filesystem::path partial = partial_name(path);
    descriptor file(partial, O_WRONLY | O_CREAT | O_EXCL);
    if (!file.is_open()) throw system_error_at(path.string(), "cannot be written", errno);
    int error = write_all(file.id(), bytes);
    if (!file.close() && error == 0) error = errno;
    if (error != 0) {
        ::unlink(partial.c_str());
        throw system_error_at(path.string(), "cannot be written", error);
    }
    rename_into_place(partial, path);
}

void rename_into_place(const std::filesystem::path& partial, const std::filesystem::path& path) {
    if (::rename(partial.c_str(), path.c_str()) == 0) return;
    const int error = errno;
    ::unlink(partial.c_str());
    throw system_error_at(path.string(), "cannot be put into place", error);
}

void require_room(const std::filesystem::path& path, std::uint64_t bytes) {
    const std::filesystem::path partial = partial_name(path);
    const descriptor file(partial, O_WRONLY | O_CREAT | O_EXCL);
    if (!file.is_open()) throw system_error_at(path.string(), "cannot be written", errno);
    const int status = ::fallocate(file.id(), 0, 0, static_cast<off_t>(bytes));
    const int error = status == 0 ? 0 : errno;
    ::unlink(partial.c_str());
    // File systems that cannot reserve room say so; there the write itself will tell.
    if (error == 0 || error == EOPNOTSUPP || error == ENOSYS || error == EINVAL) return;
    throw system_error_at(path.string(), "no room for " + std::to_string(bytes / 1024 + 1) + " KiB",
                          error);
}

void flush_to_disk(const std::filesystem::path& path) {
    const descriptor file(path, O_RDONLY);
    if (!file.is_open() || ::fsync(file.id()) != 0) {
        if (errno == EINVAL || errno == EROFS) return;  // a file system without such a notion
        throw system_error_at(path.string(), "cannot be flushed to disk", errno);
    }
}

std::vector<std::byte> read_bytes(const std::filesystem::path& path) {
    const descriptor file(path, O_RDONLY);
    struct stat status {};
    if (!file.is_open() || ::fstat(file.id(), &status) != 0) {
        throw system_error_at(path.string(), "cannot be read", errno);
    }
    std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t n = ::read(file.id(), bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw system_error_at(path.string(), "cannot be read", errno);
        if (n == 0) break;
        done += static_cast<std::size_t>(n);
    }
    bytes.resize(done);
    return bytes;
}

}  // namespace hopscotch
