// JSON lines and clocks of the benchmarks.
#include "bench/report.hpp"

#include "host/run/build_info.hpp"
#include "host/run/json.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <sched.h>
#include <sys/utsname.h>

namespace hopscotch::bench {
namespace {

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos)
            return line.substr(colon + 2);
    }
    return "unknown";
}

std::string machine_name() {
    utsname name{};
    return ::uname(&name) == 0 ? fmt::format("{} {}", name.sysname, name.machine) : "unknown";
}

}  // namespace

json_line::json_line(std::string_view benchmark) {
    const build_info& build = this_build();
    add("benchmark", benchmark);
    add("revision", build.revision);
    add("compiler", build.compiler);
    add("flags", build.flags);
    add("machine", machine_name());
    add("cpu", processor_name());
    add("cores", static_cast<double>(std::thread::hardware_concurrency()));
}

json_line& json_line::add(std::string_view name, double value) {
    text_ += fmt::format("{}{}: {}", text_.empty() ? "" : ", ", json_text(name),
                         value - value == 0.0 ? fmt::format("{:.6g}", value) : "null");
    return *this;
}

json_line& json_line::add(std::string_view name, std::string_view value) {
    text_ += fmt::format("{}{}: {}", text_.empty() ? "" : ", ", json_text(name), json_text(value));
    return *this;
}

json_line& json_line::add(std::string_view name, bool value) {
    text_ += fmt::format(", {}: {}", json_text(name), value);
    return *this;
}

void json_line::print() const {
    fmt::print("{{{}}}\n", text_);
    std::fflush(stdout);
}

double thread_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void stay_on_this_core() {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    CPU_SET(static_cast<std::size_t>(::sched_getcpu()), &cores);
    ::sched_setaffinity(0, sizeof cores, &cores);
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    const double last = static_cast<double>(values.size() - 1);
    return values[static_cast<std::size_t>(share * last + 0.5)];
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

double seconds_of(const std::function<void()>& work) {
    const double begin = thread_seconds();
    work();
    return thread_seconds() - begin;
}

std::vector<std::vector<double>> alternate(const std::vector<std::function<void()>>& pieces,
                                           int n_rounds) {
    std::vector<std::vector<double>> seconds(pieces.size());
    for (const auto& work : pieces) work();  // caches, page faults, the clock of wide registers
    for (int round = 0; round < n_rounds; ++round) {
        for (std::size_t i = 0; i < pieces.size(); ++i) seconds[i].push_back(seconds_of(pieces[i]));
    }
    return seconds;
}

}  // namespace hopscotch::bench
