#include "host/store/store_error.hpp"

#include <cerrno>
#include <system_error>

namespace hopscotch {

namespace {

std::string one_line(const std::string& place, const std::string& reason,
                     const std::string& suggestion) {
    std::string text = place + " (" + reason + ")";
    if (!suggestion.empty()) text += "; " + suggestion + "?";
    return text;
}

std::string suggestion_for(int error_number) {
    switch (error_number) {
        case ENOSPC:
        case EDQUOT:
            return "free some space and go on with --resume";
        case EFBIG:
            return "raise the file size limit (ulimit -f) and go on with --resume";
        case EACCES:
        case EPERM:
        case EROFS:
            return "choose a folder that can be written with -o";
        case ENOENT:
        case ENOTDIR:
            return "make the folder first or choose another with -o";
        case EMFILE:
        case ENFILE:
            return "raise the limit of open files (ulimit -n)";
        default:
            return "";
    }
}

}  // namespace

store_error::store_error(std::string place, std::string reason, std::string suggestion)
    : std::runtime_error(one_line(place, reason, suggestion)),
      place_(std::move(place)),
      reason_(std::move(reason)),
      suggestion_(std::move(suggestion)) {}

store_error system_error_at(const std::string& place, const std::string& action, int error_number) {
    return {place, action + ": " + std::generic_category().message(error_number),
            suggestion_for(error_number)};
}

}  // namespace hopscotch
