// Collects letters from a traced orbit.
#include "host/cli/event_word.hpp"

namespace hopscotch {
namespace {

struct speller final : orbit_observer {
    std::span<const event_letter> letters;
    std::string word;

    void phase(const char*, double, double, const sampler&) override {}
    void event(const char* name, double, const char*, const char*, const double*, const double*,
               double) override {
        for (const event_letter& letter : letters) {
            if (letter.event == name) word += letter.letter;
        }
    }
};

}  // namespace

std::string event_word(const model_entry& model, const extra_info& word, const orbit_row& row) {
    speller observer;
    observer.letters = word.letters;
    model.orbits().trace(row, observer);
    return observer.word;
}

}  // namespace hopscotch
