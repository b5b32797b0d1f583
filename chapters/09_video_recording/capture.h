// Which frame is handed on when: always the one before the frame that was drawn last.
#pragma once

#include "09_video_recording/pixels.h"
#include "common/hole.cuh"

namespace ballpit {

/// A frame has been drawn: begins to read it, and hands the frame before it to `take`, which has
/// had the time of a whole drawing to arrive. After the first frame there is none before it.
template <class Reader, class Take>
void captureDrawn(Reader& reader, Pixels& pixels, Take take) {
    // ---- hole record.frame (about 4 lines): Start this frame; if one was under way, hand that one on
    TODO_HOLE("record.frame");
    // ---- end of record.frame
}

/// No more frames are drawn: hands on what is still under way.
template <class Reader, class Take>
void captureRest(Reader& reader, Pixels& pixels, Take take) {
    // ---- hole record.last (about 4 lines): Hand on the frames that are still under way
    TODO_HOLE("record.last");
    // ---- end of record.last
}

}  // namespace ballpit
