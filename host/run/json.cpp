// The little JSON that this program writes.
#include "host/run/json.hpp"

#include <cmath>

#include <fmt/format.h>

namespace hopscotch {

std::string json_text(std::string_view text) {
    std::string result = "\"";
    for (const char letter : text) {
        if (letter == '"' || letter == '\\') result += '\\';
        if (static_cast<unsigned char>(letter) < ' ') {
            result += fmt::format("\\u{:04x}", static_cast<unsigned>(letter));
        } else {
            result += letter;
        }
    }
    return result + "\"";
}

std::string json_texts(const std::vector<std::string>& texts) {
    std::string result = "[";
    for (const std::string& text : texts)
        result += (result.size() > 1 ? ", " : "") + json_text(text);
    return result + "]";
}

std::string json_number(double x) { return std::isfinite(x) ? fmt::format("{:.17g}", x) : "null"; }

std::string json_numbers(std::span<const double> numbers) {
    std::string result = "[";
    for (const double x : numbers) result += (result.size() > 1 ? ", " : "") + json_number(x);
    return result + "]";
}

}  // namespace hopscotch
