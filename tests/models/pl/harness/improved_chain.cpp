#include "improved_chain.h"

#include <cstddef>

namespace harness {

void ImprovedChain::connect_images(bool whole_frames) {
  camera->hold(blob_stream->busy);
  pixel_stream->ena(camera->frame_ena);
  pixel_stream->pixel(camera->pixel);
  pixel_stream->more_pixels(camera->more_pixels);
  threshold->frame_ena(camera->frame_ena);
  threshold->pixel(camera->pixel);
  threshold->more_pixels(camera->more_pixels);
  threshold->x(camera->pixel_x);
  threshold->y(camera->pixel_y);
  blob_labelling->ena(threshold->binary_ena);
  blob_labelling->pixel(threshold->binary_out);
  blob_labelling->more_pixels(threshold->more_binary);
  blob_labelling->x(threshold->binary_x);
  blob_labelling->y(threshold->binary_y);
  blob_stream->frame_ena(camera->frame_ena);
  blob_stream->frame_number(camera->frame_number);
  blob_stream->threshold(threshold->active_threshold);
  blob_stream->idle(blob_labelling->idle);
  blob_stream->blob_out(blob_labelling->blob_out);
  for (std::size_t i = 0; i < blob_stream->extreme.size(); ++i)
    blob_stream->extreme[i](blob_labelling->extreme[i]);
  blob_stream->label_overflow(blob_labelling->label_overflow);
  if (!whole_frames) return;
  pixel_stream->frames(camera->frames);
  threshold->frames(camera->frames);
  blob_labelling->frames(threshold->binary_frames);
}

}  // namespace harness
