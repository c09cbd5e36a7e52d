#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include <pl/blob_labelling/blob_labelling.h>
#include <pl/blob_stream/blob_stream.h>
#include <pl/camera/camera.h>
#include <pl/global_threshold/global_threshold.h>
#include <pl/pixel_stream/pixel_stream.h>
#include <vp/signal.h>

#include "stream.h"

namespace harness {

/// What software says to the logic.
struct ChainControl {
  vp::Signal<bool> ena{"ena"}, rst{"rst"}, por{"por"}, wr_thresh{"wr_thresh"};
  vp::Signal<std::uint8_t> threshold{"threshold"};
};

/// The IP of the design `improved` that take pixels.
struct ImprovedChain {
  std::unique_ptr<pl::Camera> camera;
  std::unique_ptr<pl::PixelStream> pixel_stream;
  std::unique_ptr<pl::GlobalThreshold> threshold;
  std::unique_ptr<pl::BlobLabelling> blob_labelling;
  std::unique_ptr<pl::BlobStream> blob_stream;

  /// All but both streams. `control`: a ChainControl, or what has the same signals.
  template <class Control>
  void connect(Control& control, bool whole_frames) {
    camera->ena(control.ena);
    camera->por(control.por);
    for (vp::In<bool>* port : {&camera->rst, &pixel_stream->rst, &threshold->rst,
                               &blob_labelling->rst, &blob_stream->rst})
      port->bind(control.rst);
    threshold->por(control.por);
    threshold->wr_thresh(control.wr_thresh);
    threshold->threshold(control.threshold);
    connect_images(whole_frames);
  }

  /// What leaves the chain, with the times.
  std::string seen(const StreamSink& pixels, const StreamSink& blobs) const {
    std::string text;
    for (const StreamSink* sink : {&pixels, &blobs}) {
      for (const StreamSink::Beat& beat : sink->beats)
        text += std::to_string(beat.ps) + " " + std::to_string(beat.data) + " " +
                std::to_string(beat.last) + "\n";
    }
    for (const std::uint32_t count :
         {pixel_stream->dropped_frames.get(), pixel_stream->cut_frames.get(),
          blob_stream->dropped_frames.get(), blob_stream->dropped_blobs.get(),
          blob_labelling->label_overflow.get()})
      text += std::to_string(count) + " ";
    return text;
  }

 private:
  void connect_images(bool whole_frames);
};

}  // namespace harness
