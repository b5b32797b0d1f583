// Owners for libav's objects, and its error codes as exceptions.
#pragma once

#include <array>
#include <memory>
#include <stdexcept>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace ballpit::libav {

struct Free {
    void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(SwsContext* context) const { sws_freeContext(context); }
    void operator()(AVFormatContext* context) const {
        avio_closep(&context->pb);
        avformat_free_context(context);
    }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

inline std::string wordsFor(int error) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> words{};
    av_strerror(error, words.data(), words.size());
    return words.data();
}

/// Throws std::runtime_error if `result` is an error; `what` says what was tried.
inline void check(int result, const std::string& what) {
    if (result < 0) throw std::runtime_error(what + " failed: " + wordsFor(result));
}

}  // namespace ballpit::libav
