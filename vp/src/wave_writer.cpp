#include <vp/error.h>
#include <vp/vcd_writer.h>
#include <vp/wave_writer.h>

#ifdef MARKERVP_FST
#include "fst_writer.h"
#endif

namespace vp {

bool has_fst() {
#ifdef MARKERVP_FST
  return true;
#else
  return false;
#endif
}

std::unique_ptr<WaveWriter> open_wave_writer(const std::filesystem::path& file) {
  std::error_code ignored;
  const bool is_device = std::filesystem::exists(file, ignored) &&
                         !std::filesystem::is_regular_file(file, ignored) &&
                         !std::filesystem::is_directory(file, ignored);
  if (is_device || file.extension() == ".vcd") return std::make_unique<VcdWriter>(file);
  if (file.extension() != ".fst") {
    throw InputError("trace '" + file.string() + "': its name must end in .vcd or .fst");
  }
#ifdef MARKERVP_FST
  return std::make_unique<FstWriter>(file);
#else
  throw InputError("trace '" + file.string() +
                   "': this build has no FST; install Debian's package verilator and build again, "
                   "or name a .vcd");
#endif
}

}  // namespace vp
