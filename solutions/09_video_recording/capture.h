// Which frame is handed on when: always the one before the frame that was drawn last.
#pragma once

#include "09_video_recording/pixels.h"
//@starter #include "common/hole.cuh"

namespace ballpit {

/// A frame has been drawn: begins to read it, and hands the frame before it to `take`, which has
/// had the time of a whole drawing to arrive. After the first frame there is none before it.
template <class Reader, class Take>
void captureDrawn(Reader& reader, Pixels& pixels, Take take) {
    //@hole record.frame lines=4 "Start this frame; if one was under way, hand that one on"
    //@starter TODO_HOLE("record.frame");
    reader.start();
    if (reader.underWay() < 2) return;
    reader.fetch(pixels);
    take(pixels);
    //@end
}

/// No more frames are drawn: hands on what is still under way.
template <class Reader, class Take>
void captureRest(Reader& reader, Pixels& pixels, Take take) {
    //@hole record.last lines=4 "Hand on the frames that are still under way"
    //@starter TODO_HOLE("record.last");
    while (reader.underWay() > 0) {
        reader.fetch(pixels);
        take(pixels);
    }
    //@end
}

}  // namespace ballpit
