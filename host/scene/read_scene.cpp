// Reads a scene from beginning to end; the order of the parts is the order of this file.
#include "host/scene/readers.hpp"
#include "host/scene/scene.hpp"

namespace hopscotch {
namespace {

void read_names(scene& scene, const table_reader& root) {
    const table_reader table = root.table("scene");
    table.expect_keys({"name", "title", "reference"});
    const std::string stem = std::filesystem::path(scene.file).stem().string();
    scene.name = table.text("name").value_or(stem);
    scene.title = table.text("title").value_or(scene.name);
    scene.reference = table.text("reference").value_or("");
}

scene checked(const document& document, std::span<const std::string> overrides,
              std::span<const model_entry* const> models) {
    scene result;
    result.file = document.file;
    result.text = document.text;
    result.overrides.assign(overrides.begin(), overrides.end());
    const table_reader root = table_reader::root(document);
    root.expect_keys(
        {"scene", "model", "grid", "sweep", "start", "question", "accuracy", "output"});
    read_names(result, root);
    read_model(result, root, models);
    read_grid(result, root);
    read_sweep(result, root);
    read_start(result, root);
    check_refusals(result, root);
    read_question(result, root);
    read_accuracy(result, root);
    read_output(result, root);
    result.fingerprint = fingerprint_of(result);
    return result;
}

}  // namespace

scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides,
                 std::span<const model_entry* const> models) {
    document document = load_document(file);
    apply_overrides(document, overrides);
    return checked(document, overrides, models);
}

scene parse_scene(std::string text, std::string file, std::span<const std::string> overrides,
                  std::span<const model_entry* const> models) {
    document document = parse_document(std::move(text), std::move(file));
    apply_overrides(document, overrides);
    return checked(document, overrides, models);
}

double scene_question::number(std::string_view name, double otherwise) const {
    const auto found = numbers.find(name);
    return found == numbers.end() ? otherwise : found->second;
}

const section_info& scene::start_section() const {
    return info().sections[static_cast<std::size_t>(section)];
}

const section_info& scene::end_section() const {
    return info().sections[static_cast<std::size_t>(start_section().returns_to)];
}

std::uint64_t scene::n_cells() const {
    std::uint64_t cells = 1;
    for (const scene_axis& axis : axes) cells *= axis.cells;
    return cells;
}

}  // namespace hopscotch
