// The one class that calls HDF5: a file whose groups, datasets, dimension scales and attributes are
// named by path. HDF5's own messages are silenced and folded into the store_error that is thrown.
// The serial HDF5 library is not thread safe: whoever uses this class holds an hdf5_guard.
#pragma once

#include "host/store/hdf5_handle.hpp"
#include "host/store/store_error.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

/// Types as they lie in a file.
enum class hdf5_type : std::uint8_t { int8, int16, int32, uint32, uint64, float64, text };

/// A dataset made of chunks that the caller compresses.
struct chunked_dataset {
    hdf5_type type = hdf5_type::float64;
    std::vector<std::uint64_t> shape;
    std::vector<std::uint64_t> chunk;
    double fill = 0.0;
    int level = 4;  // of deflate, as a note to other writers
};

/// A rectangle of a virtual dataset that lies in a dataset of another file.
struct virtual_part {
    std::string file;  // relative to the folder of the virtual file, so that both can be moved
    std::string dataset;
    std::vector<std::uint64_t> origin;  // in the virtual dataset
    std::vector<std::uint64_t> extent;
    std::vector<std::uint64_t> source_shape;  // of the other dataset
    std::vector<std::uint64_t>
        source_extent;  // from its first corner on; as many cells as `extent`
};

/// A dataset whose numbers lie in other files; where one of them is missing, it reads as `fill`.
struct virtual_dataset {
    hdf5_type type = hdf5_type::float64;
    std::vector<std::uint64_t> shape;
    double fill = 0.0;
    std::vector<virtual_part> parts;
};

/// Numbers of the given type in an attribute; text attributes are plain strings.
struct typed_numbers {
    hdf5_type type = hdf5_type::float64;
    std::vector<double> values;
};

class hdf5_file {
public:
    using shape_type = std::vector<std::uint64_t>;

    static hdf5_file create(const std::filesystem::path& path);  // replaces an existing file
    /// May hold virtual datasets, which readers older than HDF5 1.10 do not know.
    static hdf5_file create_virtual(const std::filesystem::path& path);
    static hdf5_file create_in_memory(const std::string& place);
    static hdf5_file open(const std::filesystem::path& path);  // to read
    static hdf5_file open_image(std::span<const std::byte> image, const std::string& place);

    hdf5_file(hdf5_file&&) noexcept = default;
    hdf5_file& operator=(hdf5_file&&) noexcept = default;
    ~hdf5_file() = default;

    const std::string& place() const { return place_; }

    /// Writes everything out; the only way to learn of errors at the last moment.
    void close();

    /// The file's bytes (create_in_memory).
    std::vector<std::byte> image();

    bool has(const std::string& path) const;
    bool is_dataset(const std::string& path) const;
    void make_group(const std::string& path);
    std::vector<std::string> members(const std::string& group) const;  // in order of creation

    void make_dataset(const std::string& path, const chunked_dataset& dataset);
    void make_dataset(const std::string& path, const virtual_dataset& dataset);
    bool is_virtual(const std::string& path) const;
    void let_go(const std::string& path);  // of a dataset that was used and needs much memory
    /// All numbers of a chunked dataset, through HDF5's own filters; converted to its type.
    void write_all(const std::string& path, std::span<const double> values);
    void write_chunk(const std::string& path, const shape_type& origin,
                     std::span<const std::byte> bytes);
    bool has_chunk(const std::string& path, const shape_type& origin) const;
    /// The compressed bytes of a chunk; none where it was never written.
    std::optional<std::vector<std::byte>> read_chunk(const std::string& path,
                                                     const shape_type& origin);

    void write(const std::string& path, const shape_type& shape, std::span<const double> values);
    void write(const std::string& path, const shape_type& shape,
               std::span<const std::uint64_t> values);
    void write(const std::string& path, hdf5_type type, const shape_type& shape,
               std::span<const double> values);  // converted to an integer type
    void write(const std::string& path, std::span<const std::string> texts);
    void write(const std::string& path, const shape_type& shape,
               std::span<const std::string> texts);

    hdf5_type type_of(const std::string& path) const;
    shape_type shape_of(const std::string& path) const;
    shape_type chunk_of(const std::string& path) const;  // empty where it is not chunked
    std::vector<double> read_doubles(const std::string& path) const;
    std::vector<std::uint64_t> read_words(const std::string& path) const;
    std::vector<std::string> read_texts(const std::string& path) const;

    void make_scale(const std::string& path, const std::string& name);
    void attach_scale(const std::string& path, const std::string& scale, unsigned axis);
    /// Names of the scales of every axis of a dataset.
    std::vector<std::string> scales_of(const std::string& path) const;

    /// Text as netCDF's characters (CF attributes: every reader knows them).
    void set_attribute(const std::string& object, const std::string& name, std::string_view text);
    /// Text as a string of any length (h5py and MATLAB give it back as text).
    void set_text(const std::string& object, const std::string& name, const std::string& text);
    void set_attribute(const std::string& object, const std::string& name,
                       const typed_numbers& values);
    void set_words(const std::string& object, const std::string& name,
                   std::span<const std::uint64_t> words);
    std::vector<std::string> attribute_names(const std::string& object) const;
    bool has_attribute(const std::string& object, const std::string& name) const;
    bool is_text_attribute(const std::string& object, const std::string& name) const;
    std::string attribute_text(const std::string& object, const std::string& name) const;
    std::vector<double> attribute_numbers(const std::string& object, const std::string& name) const;
    std::vector<std::uint64_t> attribute_words(const std::string& object,
                                               const std::string& name) const;

private:
    hdf5_file(hdf5_handle file, std::string place);

    hdf5_handle::identifier dataset(const std::string& path) const;  // opened once, then kept
    hdf5_handle object(const std::string& path) const;
    hdf5_handle attribute(const std::string& object, const std::string& name) const;
    void put_attribute(const std::string& object, const std::string& name,
                       hdf5_handle::identifier file_type, hdf5_handle::identifier memory_type,
                       const hdf5_handle& space, const void* values);
    void write_dense(const std::string& path, hdf5_type type, const shape_type& shape,
                     hdf5_handle::identifier memory_type, const void* values);
    [[noreturn]] void fail(const std::string& action) const;
    hdf5_handle checked(hdf5_handle::identifier id, const std::string& action) const;
    void check(int status, const std::string& action) const;

    std::string place_;
    hdf5_handle file_;
    mutable std::map<std::string, hdf5_handle> datasets_;  // destroyed before the file
};

}  // namespace hopscotch
