// Small files written so that a reader sees either nothing or all of it: under a temporary name in
// the same folder, then renamed. Used for tile files; large files use the same temporary names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace hopscotch {

/// Part of every temporary name, so that leftovers of a killed run can be found and removed.
inline constexpr std::string_view partial_mark = ".partial-";

/// A temporary name next to `path`, different for every process, host and call.
std::filesystem::path partial_name(const std::filesystem::path& path);

/// \error  store_error; nothing is left behind and an older file stays as it was
void write_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Renames a finished temporary file into place. \error store_error
void rename_into_place(const std::filesystem::path& partial, const std::filesystem::path& path);

/// Finds out whether a file of that size can be written there, without leaving it behind.
/// \error  store_error where the disk has no room, the folder is read-only ...
void require_room(const std::filesystem::path& path, std::uint64_t bytes);

/// Waits until the file is on the disk itself, so that the run directory may go.
void flush_to_disk(const std::filesystem::path& path);

/// The bytes of a file. \error store_error
std::vector<std::byte> read_bytes(const std::filesystem::path& path);

}  // namespace hopscotch
