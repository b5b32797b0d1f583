// From the screen's colours to the video's: RGB to YUV, and the top row first.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "09_video_recording/pixels.h"
//@starter #include "common/hole.cuh"
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
    //@hole convert.pixel lines=4 "The brightness, and how far blue and red are from it"
    //@starter TODO_HOLE("convert.pixel");
    //@starter return {};
    const double y = 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
    const double u = (color.b - y) / 1.8556, v = (color.r - y) / 1.5748;
    const auto scaled = [](double value, double range) { return std::lround(value * range / 255); };
    return {static_cast<int>(16 + scaled(y, 219)), static_cast<int>(128 + scaled(u, 224)),
            static_cast<int>(128 + scaled(v, 224))};
    //@end
}

/// How to walk through a picture from its top row down.
struct Rows {
    const std::uint8_t* top;  ///< the first byte of the top row
    int step;                 ///< from one row to the row below it, in bytes; may be negative
};

/// A picture that lies upside down in memory needs no copy: who starts at its last row and walks
/// backwards sees it upright.
inline Rows rowsFromTop(const Pixels& pixels) {
    //@hole convert.flip lines=4 "The top row, and the step to the row below it"
    //@starter TODO_HOLE("convert.flip");
    //@starter return {pixels.bytes.data(), pixels.channels * pixels.width};
    const int rowBytes = pixels.channels * pixels.width;
    if (!pixels.bottomUp) return {pixels.bytes.data(), rowBytes};
    const std::size_t above = pixels.bytes.size() - static_cast<std::size_t>(rowBytes);
    return {pixels.bytes.data() + above, -rowBytes};
    //@end
}

/// How libswscale names pixels of so many bytes, in the order in which the bytes lie in memory.
inline AVPixelFormat formatOf(int channels) {
    //@hole convert.format lines=1 "Red first, green, blue; with alpha behind them or without"
    //@starter TODO_HOLE("convert.format");
    //@starter return AV_PIX_FMT_GRAY8;
    return channels == 4 ? AV_PIX_FMT_RGBA : AV_PIX_FMT_RGB24;
    //@end
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
        //@hole convert.picture lines=2 "Scale all rows, from the rows above to the picture's"
        //@starter TODO_HOLE("convert.picture");
        sws_scale(context_.get(), &rows.top, &rows.step, 0, pixels.height, picture.data,
                  picture.linesize);
        //@end
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
        //@hole convert.colors lines=3 "Tell libswscale: BT.709, from full to limited range"
        //@starter TODO_HOLE("convert.colors");
        const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
        sws_setColorspaceDetails(&context, bt709, full, bt709, limited, unchanged, unity, unity);
        //@end
    }

    libav::Owned<SwsContext> context_;
};

}  // namespace ballpit
