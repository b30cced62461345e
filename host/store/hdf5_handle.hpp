// What every use of HDF5 needs: the lock of the library, identifiers that close themselves, and the
// reason of a failure in words. For hdf5_file; others hold the guard only.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>

namespace hopscotch {

/// Held during any use of HDF5; may be taken again by the same thread.
class hdf5_guard {
public:
    hdf5_guard();

private:
    std::unique_lock<std::recursive_mutex> lock_;
};

/// Owns one HDF5 identifier of any kind.
class hdf5_handle {
public:
    using identifier = std::int64_t;  // HDF5's hid_t

    hdf5_handle() = default;
    explicit hdf5_handle(identifier id) : id_(id) {}
    ~hdf5_handle() { reset(); }
    hdf5_handle(hdf5_handle&& other) noexcept;
    hdf5_handle& operator=(hdf5_handle&& other) noexcept;

    identifier id() const { return id_; }
    explicit operator bool() const { return id_ >= 0; }
    bool reset() noexcept;  // false where HDF5 could not close it

private:
    identifier id_ = -1;
};

/// HDF5's own explanation of the last failure: its innermost message.
std::string hdf5_reason();

/// The same without HDF5's file names and flags.
std::string hdf5_words(const std::string& reason);

/// What to do about it where the failure is the disk's; empty else.
std::string hdf5_suggestion(const std::string& reason);

}  // namespace hopscotch
