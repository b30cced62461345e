// Events and samples of one orbit as CSV or JSON lines.
#include "host/cli/trace_writer.hpp"

#include "host/cli/evaluate.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace hopscotch {
namespace {

/// One line of the trace; null where it has no such part.
struct trace_record {
    const char* record = "";
    std::string time;
    std::string_view name = "";
    std::string_view mode_left = "";
    std::string_view mode_entered = "";
    const double* state = nullptr;
    const double* before = nullptr;
    double loss = std::nan("");
};

class trace_lines final : public orbit_observer {
public:
    trace_lines(const model_info& info, int samples, trace_format format)
        : columns_(info.trace_columns), samples_(samples), format_(format) {
        if (format_ == trace_format::csv) add_header();
    }

    void phase(const char* mode, double start_time, double duration, const sampler& at) override {
        std::vector<double> state(columns_.size());
        // a phase without an end shows its beginning
        const int n = std::isfinite(duration) ? samples_ : std::min(samples_, 1);
        for (int i = 0; i < n; ++i) {
            const double t = n == 1 ? 0.0 : duration * i / (n - 1);
            at.state_at(t, state.data());
            add({"sample", number_text(start_time + t), "", mode, mode, state.data(), nullptr,
                 std::nan("")});
        }
    }

    void event(const char* name, double time, const char* mode_left, const char* mode_entered,
               const double* before, const double* after, double loss) override {
        add({"event", number_text(time), name, mode_left, mode_entered, after, before, loss});
    }

    std::string finish(const orbit_answer& answer) {
        trace_record end;
        end.record = "end";
        end.time = answer.time;
        end.name = name_of(answer.end);
        add(end);
        return std::move(text_);
    }

private:
    void add_header() {
        text_ = "record,time,name,mode_left,mode_entered";
        for (const column_info& column : columns_) text_ += fmt::format(",{}", column.name);
        for (const column_info& column : columns_) text_ += fmt::format(",before_{}", column.name);
        text_ += ",loss\n";
    }

    void add(const trace_record& record) {
        if (format_ == trace_format::csv)
            add_csv(record);
        else
            add_json(record);
    }

    void add_csv(const trace_record& record) {
        text_ += fmt::format("{},{},{},{},{}", record.record, record.time, record.name,
                             record.mode_left, record.mode_entered);
        for (const double* state : {record.state, record.before}) {
            for (std::size_t i = 0; i < columns_.size(); ++i) {
                text_ += "," + (state == nullptr ? "" : number_text(state[i]));
            }
        }
        text_ += "," + number_text(record.loss) + "\n";
    }

    void add_json(const trace_record& record) {
        text_ += fmt::format("{{\"record\": \"{}\", \"time\": {}", record.record, record.time);
        if (!record.name.empty()) text_ += fmt::format(", \"name\": \"{}\"", record.name);
        if (!record.mode_left.empty()) {
            text_ += fmt::format(", \"mode_left\": \"{}\", \"mode_entered\": \"{}\"",
                                 record.mode_left, record.mode_entered);
        }
        if (record.before != nullptr) add_json_state("before", record.before);
        if (record.state != nullptr)
            add_json_state(record.before ? "after" : "state", record.state);
        if (std::isfinite(record.loss)) text_ += fmt::format(", \"loss\": {:.17g}", record.loss);
        text_ += "}\n";
    }

    void add_json_state(const char* name, const double* state) {
        text_ += fmt::format(", \"{}\": {{", name);
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const std::string number = std::isfinite(state[i]) ? number_text(state[i]) : "null";
            text_ += fmt::format("{}\"{}\": {}", i == 0 ? "" : ", ", columns_[i].name, number);
        }
        text_ += "}";
    }

    std::span<const column_info> columns_;
    int samples_;
    trace_format format_;
    std::string text_;
};

}  // namespace

std::string trace_text(const model_entry& model, const orbit_row& row, int samples,
                       trace_format format) {
    if (model.orbits_table == nullptr || model.orbits().trace == nullptr) {
        throw std::invalid_argument(fmt::format("{} is built without traces", model.info->name));
    }
    trace_lines lines(*model.info, samples, format);
    const orbit_answer answer = model.orbits().trace(row, lines);
    return lines.finish(answer);
}

}  // namespace hopscotch
