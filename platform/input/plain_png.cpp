#include <input/plain_png.h>

#include <png.h>

#include <csetjmp>
#include <cstring>

namespace platform::input {

namespace {

struct Cursor {
  const std::uint8_t* data;
  std::size_t left;
};

void take(png_structp png, png_bytep target, std::size_t size) {
  auto* cursor = static_cast<Cursor*>(png_get_io_ptr(png));
  if (size > cursor->left) png_error(png, "truncated");
  std::memcpy(target, cursor->data, size);
  cursor->data += size;
  cursor->left -= size;
}

[[noreturn]] void fail(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}
void ignore(png_structp, png_const_charp) {}

/// libpng leaves by longjmp when the data is damaged, so nothing here has a destructor.
bool decode(Cursor cursor, std::uint8_t* pixels, std::size_t width, std::size_t height) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, &cursor, take);
  png_read_info(png, info);
  for (std::size_t y = 0; y < height; ++y) png_read_row(png, pixels + y * width, nullptr);
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

}  // namespace

std::optional<GreyImage> read_plain_png(const std::vector<std::uint8_t>& bytes, int width,
                                        int height) {
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  GreyImage image{width, height, std::vector<std::uint8_t>(columns * rows)};
  if (!decode({bytes.data(), bytes.size()}, image.pixels.data(), columns, rows))
    return std::nullopt;
  return image;
}

}  // namespace platform::input
