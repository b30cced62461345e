// What is wrong with a scene or an input file, said in one line:
// `file:line: key = value (why); suggestion?`. Thrown by every reader of user input; exit code 3.
#pragma once

#include <stdexcept>
#include <string>

namespace hopscotch {

/// The five parts of the message. An empty suggestion is left out, and so is an empty value.
struct mistake {
    std::string place;  // "scene.toml:14", "command line", "rows.csv:7"
    std::string key;    // "grid.axis[1].cells"
    std::string value;  // as it would be written in the file; "" where the key is missing
    std::string why;
    std::string suggestion;  // without the question mark

    std::string line() const;
};

class scene_error : public std::runtime_error {
public:
    explicit scene_error(const mistake& what) : std::runtime_error(what.line()) {}
};

}  // namespace hopscotch
