#include <detectors/peers.h>

#include <host/process.h>

#define MARKERVP_TEXT_OF(name) #name
#define MARKERVP_TEXT(name) MARKERVP_TEXT_OF(name)

namespace platform::detectors {

std::vector<std::unique_ptr<Peer>> make_peers(const MarkerSet& markers) {
  const auto entry = reinterpret_cast<decltype(&MARKERVP_PEERS_ENTRY)>(
      host::load_plugin(host::library_folders(), "libmarkervp_peers.so",
                        MARKERVP_TEXT(MARKERVP_PEERS_ENTRY), "there is nothing to compare with"));
  return entry()->peers(markers);
}

}  // namespace platform::detectors
