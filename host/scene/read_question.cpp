// [question] and [accuracy]: what the map shows and how exactly it is computed.
#include "host/scene/readers.hpp"

#include "host/scene/questions.hpp"
#include "host/scene/suggest.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

namespace hopscotch {
namespace {

constexpr std::int64_t most_returns = std::numeric_limits<std::int32_t>::max();

const question_kind& read_kind(const table_reader& table) {
    const auto known = names_of(question_kinds());
    const auto name = table.text("kind");
    if (!name) table.missing("kind", "a scene asks a question", "one of " + listed(known));
    const question_kind* kind = find_question(*name);
    if (kind == nullptr) table.refuse("kind", "no such question", suggest(*name, known));
    return *kind;
}

void read_number(scene& scene, const table_reader& table, const question_number& number) {
    const auto value = table.number(number.name);
    if (value && *value < number.least) {
        table.refuse(number.name, fmt::format("must be at least {}", number.least));
    }
    if (value && number.is_whole) {
        table.whole(number.name, static_cast<std::int64_t>(number.least), most_returns);
    }
    scene.question.numbers.emplace(number.name, value.value_or(number.standard));
}

}  // namespace

void read_question(scene& scene, const table_reader& root) {
    const table_reader table = root.table("question");
    const question_kind& kind = read_kind(table);
    std::vector<std::string_view> known = names_of(kind.numbers);
    known.insert(known.end(), {"kind", "returns"});
    table.expect_keys(known, fmt::format("key of the question {}", kind.name));
    scene.question.place = table.place("kind");
    scene.question.kind = kind.name;
    scene.question.has_labels = kind.has_labels;
    scene.question.returns = static_cast<std::uint32_t>(
        table.whole("returns", 1, most_returns).value_or(kind.standard_returns));
    for (const question_number& number : kind.numbers) read_number(scene, table, number);
    if (scene.refine > 0 && !kind.has_classes) {
        root.table("grid").refuse("refine",
                                  fmt::format("the question {} has no classes whose boundaries "
                                              "could be refined",
                                              kind.name),
                                  "refine = 0");
    }
}

void read_accuracy(scene& scene, const table_reader& root) {
    constexpr std::array<std::string_view, 3> precisions{"double", "dd", "mp50"};
    const table_reader table = root.table("accuracy");
    table.expect_keys({"precision", "audit_cells", "tolerance", "max_events"});
    scene_accuracy& accuracy = scene.accuracy;
    accuracy.place = table.place("precision");
    accuracy.precision = table.text("precision").value_or(accuracy.precision);
    if (std::find(precisions.begin(), precisions.end(), accuracy.precision) == precisions.end()) {
        table.refuse("precision", "no such precision", suggest(accuracy.precision, precisions));
    }
    accuracy.audit_cells = find_question(scene.question.kind)->standard_audit_cells;
    accuracy.audit_cells =
        static_cast<std::uint64_t>(table.whole("audit_cells", 0, 1'000'000'000)
                                       .value_or(static_cast<std::int64_t>(accuracy.audit_cells)));
    accuracy.tolerance = table.number("tolerance").value_or(accuracy.tolerance);
    if (!(accuracy.tolerance >= least_tolerance && accuracy.tolerance <= greatest_tolerance)) {
        table.refuse("tolerance", "outside [1e-16, 0.01]", "1e-10");
    }
    accuracy.max_events =
        static_cast<std::uint64_t>(table.whole("max_events", 1, 1'000'000'000'000)
                                       .value_or(static_cast<std::int64_t>(accuracy.max_events)));
}

}  // namespace hopscotch
