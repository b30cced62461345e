// Reads and writes lock files' text.
#include "host/store/lock_holder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace hopscotch {

namespace {

std::string variable(const char* name, const char* otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr && *text != '\0' ? text : otherwise;
}

std::string utc(std::time_t time) {
    std::tm parts{};
    ::gmtime_r(&time, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

std::time_t time_of(const std::string& utc) {
    std::tm parts{};
    return ::strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts) != nullptr ? ::timegm(&parts) : 0;
}

std::string duration_text(std::time_t seconds) {
    const long whole = std::max<long>(0, static_cast<long>(seconds));
    char text[48];
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
    return text;
}

}  // namespace

std::string host_name() {
    char name[256] = "unknown";
    ::gethostname(name, sizeof name - 1);
    return name;
}

std::string age_of(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return "unknown";
    return duration_text(std::time(nullptr) - status.st_mtime);
}

lock_holder lock_holder::this_process() {
    return {::getpid(), host_name(), utc(std::time(nullptr)), variable("SLURM_JOB_ID", "-"),
            variable("SLURM_RESTART_COUNT", "0")};
}

std::string lock_holder::line() const {
    return "process " + std::to_string(process) + " host " + host + " since " + since + " job " +
           job + " start " + start + "\n";
}

lock_holder lock_holder::read(int descriptor) {
    std::array<char, 1024> text{};
    if (::pread(descriptor, text.data(), text.size() - 1, 0) <= 0) return {};
    char host[256] = "";
    char since[64] = "";
    char job[64] = "-";
    char start[32] = "0";
    lock_holder result;
    const int n = std::sscanf(text.data(), "process %ld host %255s since %63s job %63s start %31s",
                              &result.process, host, since, job, start);
    if (n < 3) return {};
    result.host = host;
    result.since = since;
    result.job = job;
    result.start = start;
    return result;
}

bool lock_holder::is_on_this_host() const { return host == host_name(); }

bool lock_holder::is_earlier_start_of_this_job() const {
    const lock_holder me = this_process();
    return me.job != "-" && me.job == job && me.start != start;
}

std::string lock_holder::words() const {
    if (process == 0) return "a process that has not written its name yet";
    const std::string of_job = job == "-" ? "" : " (job " + job + ")";
    return "process " + std::to_string(process) + " on " + host + of_job + ", started " + since +
           " (" + duration_text(std::time(nullptr) - time_of(since)) + " ago)";
}

}  // namespace hopscotch
