#include "host/store/hdf5_handle.hpp"

#include <hdf5.h>

#include <utility>

namespace hopscotch {

namespace {

std::recursive_mutex& hdf5_mutex() {
    static std::recursive_mutex mutex;
    return mutex;
}

}  // namespace

hdf5_guard::hdf5_guard() : lock_(hdf5_mutex()) { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

hdf5_handle::hdf5_handle(hdf5_handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}

hdf5_handle& hdf5_handle::operator=(hdf5_handle&& other) noexcept {
    if (this != &other) {
        reset();
        id_ = std::exchange(other.id_, -1);
    }
    return *this;
}

bool hdf5_handle::reset() noexcept {
    if (id_ < 0) return true;
    const hid_t id = std::exchange(id_, -1);
    switch (H5Iget_type(id)) {
        case H5I_FILE:
            return H5Fclose(id) >= 0;
        case H5I_GROUP:
            return H5Gclose(id) >= 0;
        case H5I_DATATYPE:
            return H5Tclose(id) >= 0;
        case H5I_DATASPACE:
            return H5Sclose(id) >= 0;
        case H5I_DATASET:
            return H5Dclose(id) >= 0;
        case H5I_ATTR:
            return H5Aclose(id) >= 0;
        case H5I_GENPROP_LST:
            return H5Pclose(id) >= 0;
        default:
            return false;
    }
}

std::string hdf5_reason() {
    std::string reason;
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_DOWNWARD,
        [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
            if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
            return 0;
        },
        &reason);
    H5Eclear2(H5E_DEFAULT);
    return reason;
}

std::string hdf5_suggestion(const std::string& reason) {
    const bool is_full = reason.find("errno = 28") != std::string::npos ||
                         reason.find("errno = 27") != std::string::npos ||
                         reason.find("errno = 122") != std::string::npos;
    return is_full ? "free some space and go on with --resume" : "";
}

std::string hdf5_words(const std::string& reason) {
    const std::size_t begin = reason.find("error message = '");
    if (begin == std::string::npos) return reason;
    const std::size_t from = begin + std::string("error message = '").size();
    return reason.substr(from, reason.find('\'', from) - from);
}

}  // namespace hopscotch
