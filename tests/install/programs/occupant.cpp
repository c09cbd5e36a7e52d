// Maps a page of its own file where the virtual platform wants its DDR.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace {

__attribute__((constructor)) void occupy() {
  Dl_info own{};
  dladdr(reinterpret_cast<void*>(&occupy), &own);
  const int file = open(own.dli_fname, O_RDONLY);
  mmap(reinterpret_cast<void*>(0x1000'0000), 4096, PROT_READ, MAP_PRIVATE | MAP_FIXED, file, 0);
  close(file);
}

}  // namespace
