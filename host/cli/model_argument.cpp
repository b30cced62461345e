// Models and sections as arguments of commands.
#include "host/cli/model_argument.hpp"

#include "host/cli/usage_error.hpp"
#include "host/scene/suggest.hpp"

#include <fmt/format.h>

namespace hopscotch {

const model_entry& model_named(const std::string& name) {
    if (const model_entry* entry = find_model(name)) return *entry;
    std::vector<std::string_view> known;
    for (const model_entry* entry : all_models()) known.push_back(entry->info->name);
    throw usage_error(fmt::format("{} (no such model); {}?", name, suggest(name, known)));
}

int section_named(const model_info& info, const std::string& name) {
    if (name.empty()) return 0;
    const int index = index_of(info.sections, name);
    if (index >= 0) return index;
    throw usage_error(fmt::format("--section {} (no section of {}); {}?", name, info.name,
                                  suggest(name, names_of(info.sections))));
}

}  // namespace hopscotch
