// The one-line grammar of messages about user input.
#include "host/scene/error.hpp"

namespace hopscotch {

std::string mistake::line() const {
    std::string text = place + ": " + key;
    if (!value.empty()) text += " = " + value;
    text += " (" + why + ")";
    if (!suggestion.empty()) text += "; " + suggestion + "?";
    return text;
}

}  // namespace hopscotch
