// Scene to attributes and back.
#include "host/run/attributes.hpp"

#include "host/run/build_info.hpp"
#include "host/store/store_error.hpp"

#include <fmt/format.h>

namespace hopscotch {
namespace {

std::string joined(const std::vector<std::string>& lines) {
    return fmt::format("{}", fmt::join(lines, "\n"));
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> lines;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

}  // namespace

attribute_list attributes_of(const scene& scene, const kernel_choice& kernel) {
    const build_info& build = this_build();
    attribute_list attributes{{"title", scene.title},
            {"references", scene.reference},
            {"source", fmt::format("hopscotch {} ({})", build.version, build.revision)},
            {"name", scene.name},
            {"model", std::string(scene.info().name)},
            {"section", std::string(scene.start_section().name)},
            {"question", scene.question.kind},
            {"precision", scene.accuracy.precision},
            {"version", std::string(build.version)},
            {"revision", std::string(build.revision)},
            {"compiler", build.compiler},
            {"flags", std::string(build.flags)},
            {"scene_file", scene.file},
            {"scene", scene.text},
            {"overrides", joined(scene.overrides)}};
    for (auto& attribute : attributes_of(kernel.which)) attributes.push_back(std::move(attribute));
    return attributes;
}

scene scene_of(const map_reader& map, std::span<const model_entry* const> models) {
    return scene_of(map.attributes(), models);
}

scene scene_of(const attribute_list& attributes, std::span<const model_entry* const> models) {
    const auto attribute = [&](std::string_view name) -> std::string {
        for (const auto& [key, value] : attributes) {
            if (key == name) return value;
        }
        return {};
    };
    const std::string text = attribute("scene");
    if (text.empty()) throw store_error("map", "holds no scene", "a file written by `run`");
    const scene result =
        parse_scene(text, attribute("scene_file"), split(attribute("overrides")), models);
    if (result.fingerprint != attribute("fingerprint")) {
        throw store_error("map",
                          "this version reads its scene differently, the fingerprints differ",
                          "the version in its attribute `source`");
    }
    return result;
}

}  // namespace hopscotch
