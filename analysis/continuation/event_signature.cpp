// Traces an orbit and spells its events.
#include "analysis/continuation/event_signature.hpp"

#include "analysis/periodic/return_equation.hpp"

#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace hopscotch {
namespace {

class speller final : public orbit_observer {
public:
    explicit speller(const model_info& info) {
        for (const extra_info& extra : info.extras) {
            for (const event_letter& letter : extra.letters) letters_.push_back(letter);
        }
    }

    void phase(const char*, double, double, const sampler&) override {}
    void event(const char* name, double, const char*, const char*, const double*, const double*,
               double) override {
        events_.emplace_back(name);
    }

    std::string word() const {
        std::string text;
        for (std::size_t i = 0; i < events_.size();) {
            std::size_t next = i + 1;
            while (next < events_.size() && events_[next] == events_[i]) ++next;
            text += spelt(events_[i]);
            if (next - i > 1) text += fmt::format("{}", next - i);
            i = next;
        }
        return text;
    }

private:
    std::vector<event_letter> letters_;
    std::vector<std::string> events_;

    std::string spelt(const std::string& name) const {
        for (const event_letter& letter : letters_) {
            if (letter.event == name) return {letter.letter};
        }
        return "(" + name + ")";
    }
};

}  // namespace

std::string event_signature(const map_point& map, std::span<const double> x, int returns) {
    std::vector<double> start(x.begin(), x.end());
    wrap_phases(map, start);
    std::vector<std::string> columns;
    std::vector<std::string> parameters;
    for (const double number : start) columns.push_back(fmt::format("{:.17g}", number));
    for (const double number : map.parameters) parameters.push_back(fmt::format("{:.17g}", number));
    const orbit_row row{.section = map.section,
                        .options = map.options.data(),
                        .variant = map.variant,
                        .columns = columns,
                        .parameters = parameters,
                        .returns = static_cast<std::uint32_t>(returns),
                        .max_steps = map.max_steps};
    speller spelling(*map.model->info);
    map.model->orbits().trace(row, spelling);
    return spelling.word();
}

}  // namespace hopscotch
