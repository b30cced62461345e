// What all benchmarks share: time of the calling thread, medians, one core, and JSON lines that say
// on what they were measured.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch::bench {

/// One result: a line of JSON. The revision, compiler, flags and machine come with every line.
class json_line {
public:
    explicit json_line(std::string_view benchmark);
    json_line& add(std::string_view name, double value);
    json_line& add(std::string_view name, std::string_view value);
    json_line& add(std::string_view name, const char* value) {
        return add(name, std::string_view(value));
    }
    json_line& add(std::string_view name, bool value);
    void print() const;

private:
    std::string text_;
};

/// Seconds of processor time that the calling thread has used: other programs on the same core do
/// not count (a hypervisor that takes the core away does).
double thread_seconds();

/// Keeps the calling thread on the core it runs on.
void stay_on_this_core();

double median(std::vector<double> values);
double quantile(std::vector<double> values, double share);

/// Seconds of one call, by `thread_seconds`.
double seconds_of(const std::function<void()>& work);

/// Alternates between several pieces of work, so that all of them see the same state of the
/// machine. \return  seconds[piece][round]
std::vector<std::vector<double>> alternate(const std::vector<std::function<void()>>& pieces,
                                           int n_rounds);

}  // namespace hopscotch::bench
