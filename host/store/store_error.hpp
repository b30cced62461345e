// What goes wrong with files: one typed error whose text is one line, `PLACE (reason);
// suggestion?`. The command line prints it and ends with exit code 4.
#pragma once

#include <stdexcept>
#include <string>

namespace hopscotch {

class store_error : public std::runtime_error {
public:
    store_error(std::string place, std::string reason, std::string suggestion = {});

    const std::string& place() const { return place_; }
    const std::string& reason() const { return reason_; }
    const std::string& suggestion() const { return suggestion_; }  // may be empty

private:
    std::string place_;
    std::string reason_;
    std::string suggestion_;
};

/// The error for a failed system call on a file: the reason is errno in words, the suggestion fits
/// it (disk full, no permission, read-only file system ...).
store_error system_error_at(const std::string& place, const std::string& action, int error_number);

}  // namespace hopscotch
