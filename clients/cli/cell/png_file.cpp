#include "clients/cli/cell/png_file.hpp"

#include <png.h>

#include "clients/cli/exit_code.hpp"
#include "clients/cli/files.hpp"

namespace sculpt::cli {

void write_png(const std::filesystem::path& file, const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) == 0)
    throw Failure(exit_failed, "file_unwritable", file.string() + " cannot be made: " + image.message);
  bytes.resize(size);
  PartFile output(file);
  output.stream() << bytes;
  output.finish();
}

}  // namespace sculpt::cli
