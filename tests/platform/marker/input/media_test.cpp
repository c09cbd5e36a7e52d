#include <marker/input/media.h>

#include "image_kit.h"
#include "temporary_files.h"

using namespace platform::input;
using kit::TemporaryFolder;

BOOST_AUTO_TEST_SUITE(media_plugin)

BOOST_AUTO_TEST_CASE(it_is_found_beside_the_executable) {
  const Decoded<platform::GreyImage> image = media().decode_image({'B', 'M', 0}, Samples::whole);
  BOOST_TEST((std::get<Unreadable>(image) == Unreadable::damaged));
}

BOOST_AUTO_TEST_CASE(a_missing_plugin_is_named_with_its_folders) {
  const TemporaryFolder folder;
  CHECK_REFUSED(load_media({folder.path()}), "libmarkervp_media.so is missing in " + folder.path());
}

BOOST_AUTO_TEST_CASE(a_plugin_that_is_none_is_refused) {
  const TemporaryFolder folder;
  kit::write_file(folder / "libmarkervp_media.so", "no library");
  CHECK_REFUSED(load_media({folder.path()}), "cannot be read");
}

BOOST_AUTO_TEST_SUITE_END()
