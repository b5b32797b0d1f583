// From the screen's colours to the video's: RGB to YUV, and the top row first.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "09_video_recording/pixels.h"
#include "common/hole.cuh"
#include "common/libav.h"

namespace ballpit {

/// A colour as screens have it: red, green and blue, each from 0 to 255.
struct Rgb {
    int r, g, b;
};

/// A colour as HD video has it: brightness y from 16 (black) to 235 (white); u says how much bluer
/// than grey it is, v how much redder, both from 16 to 240, with 128 for grey.
struct Yuv {
    int y, u, v;
};

/// The standard's formulas (ITU-R BT.709): brightness is a weighted mean, since eyes see green
/// best; u and v are what blue and red have beyond it, scaled so that both reach the same range.
inline Yuv yuvOf(Rgb color) {
    // ---- hole convert.pixel (about 4 lines): The brightness, and how far blue and red are from it
    TODO_HOLE("convert.pixel");
    return {};
    // ---- end of convert.pixel
}

/// How to walk through a picture from its top row down.
struct Rows {
    const std::uint8_t* top;  ///< the first byte of the top row
    int step;                 ///< from one row to the row below it, in bytes; may be negative
};

/// A picture that lies upside down in memory needs no copy: who starts at its last row and walks
/// backwards sees it upright.
inline Rows rowsFromTop(const Pixels& pixels) {
    // ---- hole convert.flip (about 4 lines): The top row, and the step to the row below it
    TODO_HOLE("convert.flip");
    return {pixels.bytes.data(), pixels.channels * pixels.width};
    // ---- end of convert.flip
}

/// How libswscale names pixels of so many bytes, in the order in which the bytes lie in memory.
inline AVPixelFormat formatOf(int channels) {
    // ---- hole convert.format (about 1 line): Red first, green, blue; with alpha behind them or without
    TODO_HOLE("convert.format");
    return AV_PIX_FMT_GRAY8;
    // ---- end of convert.format
}

/// Converts pictures of one kind to YUV 4:2:0: one y for each pixel, one u and v for each block of
/// two by two.
class FrameConverter {
public:
    FrameConverter(int width, int height, int channels)
        : context_(makeContext(width, height, formatOf(channels))) {
        if (!context_) throw std::runtime_error("video: libswscale cannot convert RGB to YUV");
        setColors(*context_);
    }

    /// `picture` has room for the result. Its rows may be longer than they need to be.
    void convert(const Pixels& pixels, AVFrame& picture) {
        const Rows rows = rowsFromTop(pixels);
        // ---- hole convert.picture (about 2 lines): Scale all rows, from the rows above to the picture's
        TODO_HOLE("convert.picture");
        // ---- end of convert.picture
    }

private:
    static libav::Owned<SwsContext> makeContext(int width, int height, AVPixelFormat from) {
        return libav::Owned<SwsContext>(sws_getContext(width, height, from, width, height,
                                                       AV_PIX_FMT_YUV420P, SWS_BILINEAR, nullptr,
                                                       nullptr, nullptr));
    }

    /// RGB uses 0 to 255; YUV 16 to 235, by BT.709. (libswscale's default is BT.601, for old TVs.)
    static void setColors(SwsContext& context) {
        const int full = 1, limited = 0, unchanged = 0, unity = 1 << 16;
        // ---- hole convert.colors (about 3 lines): Tell libswscale: BT.709, from full to limited range
        TODO_HOLE("convert.colors");
        // ---- end of convert.colors
    }

    libav::Owned<SwsContext> context_;
};

}  // namespace ballpit
