// Child processes of the benchmarks.
#include "bench/child.hpp"

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hopscotch::bench {
namespace {

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

[[noreturn]] void become(const std::vector<std::string>& command, int output) {
    std::vector<char*> arguments;
    for (const std::string& argument : command)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    ::dup2(output, STDOUT_FILENO);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
}

std::string read_all(int input) {
    std::string text;
    std::array<char, 4096> buffer;
    for (;;) {
        const ssize_t n = ::read(input, buffer.data(), buffer.size());
        if (n <= 0) return text;
        text.append(buffer.data(), static_cast<std::size_t>(n));
    }
}

}  // namespace

child_result run_child(const std::vector<std::string>& command) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
    const auto begin = std::chrono::steady_clock::now();
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) become(command, ends[1]);
    ::close(ends[1]);
    child_result result;
    result.output = read_all(ends[0]);
    ::close(ends[0]);
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    const auto end = std::chrono::steady_clock::now();
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.wall_seconds = std::chrono::duration<double>(end - begin).count();
    result.processor_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    result.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
    if (result.exit_code != 0) {
        throw std::runtime_error(
            fmt::format("{} ended with {}", fmt::join(command, " "), result.exit_code));
    }
    return result;
}

double json_number_of(const std::string& json, const std::string& key) {
    const std::string quoted = '"' + key + "\":";
    const std::size_t at = json.find(quoted);
    if (at == std::string::npos) throw std::runtime_error("no " + key + " in the run's summary");
    return std::strtod(json.c_str() + at + quoted.size(), nullptr);
}

std::string text_of_file(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

program_and_scene arguments_of(int argc, char** argv) {
    if (argc != 3) throw std::runtime_error(fmt::format("usage: {} PROGRAM SCENE", argv[0]));
    return {argv[1], argv[2]};
}

scratch_directory::scratch_directory() {
    std::string name = (std::filesystem::temp_directory_path() / "hopscotch-bench-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path_ = name;
}

scratch_directory::~scratch_directory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace hopscotch::bench
