#pragma once
/** @file
Moving pictures: an animated WebP file, which every current browser shows. */

#include <memory>
#include <string>

#include "core/render/scene.h"

namespace graspbench {

/** Takes the pictures one by one, so that a long film needs the memory of few. */
class AnimatedWebp {
 public:
  /** @throws Error(kUnsupported) outside of 1 to 16383 pixels on a side. */
  AnimatedWebp(int width, int height);
  ~AnimatedWebp();
  /** @param time  at which it begins to be shown [s], in milliseconds when stored; later than the
  one before. @pre of the constructor's size. */
  void Add(const Image& image, double time);
  /** The file's bytes. It starts over for ever. @param end  of the last picture [s]. @pre something
  was added; to be called once. */
  std::string Finish(double end);

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace graspbench
