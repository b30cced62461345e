// Runs the program under test as a user does, and says what it cost.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hopscotch::bench {

struct child_result {
    int exit_code = 0;
    double wall_seconds = 0.0;
    double processor_seconds = 0.0;  // user and system, all threads
    double peak_bytes = 0.0;         // largest resident set
    std::string output;              // what it printed to standard output
};

/// Runs a command (argument 0 is the program) and waits for it.
/// \error  std::runtime_error where it cannot be started or fails
child_result run_child(const std::vector<std::string>& command);

/// The number behind `"key":` in JSON text.
/// \error  std::runtime_error where there is none
double json_number_of(const std::string& json, const std::string& key);

std::string text_of_file(const std::filesystem::path& file);

/// What the programs that start the program under test take: the program and a scene.
struct program_and_scene {
    std::string program;
    std::string scene;
};
program_and_scene arguments_of(int argc, char** argv);

/// A new empty directory, removed at the end.
class scratch_directory {
public:
    scratch_directory();
    ~scratch_directory();
    scratch_directory(const scratch_directory&) = delete;
    scratch_directory& operator=(const scratch_directory&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace hopscotch::bench
