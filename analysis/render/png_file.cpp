#include "analysis/render/png_file.hpp"

#include "host/store/atomic_file.hpp"
#include "host/store/store_error.hpp"

#include <png.h>

#include <cstddef>
#include <vector>

namespace hopscotch::picture {

namespace {

void append(png_structp png, png_bytep bytes, std::size_t n) {
    auto* file = static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    const auto* begin = reinterpret_cast<const std::byte*>(bytes);
    file->insert(file->end(), begin, begin + n);
}

void ignore_flush(png_structp) {}

[[noreturn]] void refuse(png_structp, const char* reason) {
    throw store_error("picture", std::string("libpng: ") + reason);
}

}  // namespace

void write_png(const std::filesystem::path& path, const canvas& picture) {
    std::vector<std::byte> file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, refuse, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file, append, ignore_flush);
    png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width()),
                 static_cast<png_uint_32>(picture.height()), 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    constexpr png_uint_32 dots_per_metre = 7874;  // 200 per inch
    png_set_pHYs(png, info, dots_per_metre, dots_per_metre, PNG_RESOLUTION_METER);
    png_write_info(png, info);
    for (int y = 0; y < picture.height(); ++y) png_write_row(png, picture.row(y).data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    write_atomically(path, file);
}

}  // namespace hopscotch::picture
