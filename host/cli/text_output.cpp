// Text results of commands.
#include "host/cli/text_output.hpp"

#include "host/store/atomic_file.hpp"
#include "host/store/store_error.hpp"

#include <cstdio>

namespace hopscotch {

void put_text(const std::string& file, const std::string& text) {
    if (!file.empty() && file != "-") {
        write_atomically(file, std::as_bytes(std::span(text)));
        return;
    }
    const std::size_t written = std::fwrite(text.data(), 1, text.size(), stdout);
    if (written != text.size() || std::fflush(stdout) != 0) {
        throw store_error("standard output", "it cannot be written");
    }
}

}  // namespace hopscotch
