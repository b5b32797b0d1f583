// Two threads: the caller's reads frames, the other converts, encodes and writes them.
#include "09_video_recording/video_recorder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "09_video_recording/capture.h"
#include "09_video_recording/encoder.h"
#include "09_video_recording/frame_converter.h"
#include "09_video_recording/frame_queue.h"
#include "09_video_recording/pixel_reader.h"
#include "09_video_recording/video_file.h"
#include "common/error.h"

namespace ballpit {

using libav::check;
using libav::Owned;

namespace {

/// Enough that neither thread waits for a frame that takes longer than most; 8 MB each at
/// 1920x1080.
constexpr std::size_t queueCapacity = 4;

void checkSize(int width, int height) {
    const std::string asked = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1)
        throw InputError("video size " + asked + ": width and height must be at least 2");
    if (width % 2 == 0 && height % 2 == 0) return;
    const auto even = [](int size) { return std::to_string(std::max(2, size - size % 2)); };
    throw InputError("video size " + asked + ": H.264 needs an even width and height; use " +
                     even(width) + "x" + even(height));
}

std::string checkedPath(std::string path, int width, int height, int framesPerSecond) {
    av_log_set_level(AV_LOG_FATAL);  // its errors come back as codes, and each is reported once
    checkSize(width, height);
    if (framesPerSecond < 1)
        throw InputError("video: " + std::to_string(framesPerSecond) +
                         " frames per second; there must be at least 1 (60 is usual)");
    checkVideoPath(path);
    return path;
}

}  // namespace

struct VideoRecorder::Stream {
    Stream(std::string path, int width, int height, int framesPerSecond,
           const std::vector<std::string>& names, int compression)
        : file(checkedPath(std::move(path), width, height, framesPerSecond)),
          encoder(openEncoder(names, width, height, framesPerSecond, file.format(), compression)) {
        file.open(*encoder);
        worker = std::thread([this] { work(); });
    }

    VideoFile file;
    Owned<AVCodecContext> encoder;
    FrameQueue<Pixels> queue{queueCapacity};
    UsedPixels used;
    std::exception_ptr failure;  // of the worker; read it after it has been joined
    std::thread worker;
    std::optional<PixelReader> reader;
    Pixels arriving;
    int frameCount = 0;
    bool released = false;

    // On the caller's thread.
    void hand(Pixels& pixels);
    void handRest();
    void finishWorker();

    // On the worker's thread.
    void work() noexcept;
    void encodeAll();
};

/// Moves a picture into the queue. If the encoder has failed, its error is thrown here.
void VideoRecorder::Stream::hand(Pixels& pixels) {
    if (queue.push(pixels)) {
        pixels = used.take();
        return;
    }
    finishWorker();
    throw std::runtime_error("video: the encoder took no more frames");
}

void VideoRecorder::Stream::handRest() {
    if (reader) captureRest(*reader, arriving, [&](Pixels& pixels) { hand(pixels); });
}

void VideoRecorder::Stream::finishWorker() {
    queue.close();
    if (worker.joinable()) worker.join();
    if (failure) std::rethrow_exception(failure);
}

void VideoRecorder::Stream::work() noexcept {
    try {
        encodeAll();
    } catch (...) {
        failure = std::current_exception();
    }
    queue.close();  // after a failure: the other thread must not wait for room
}

void VideoRecorder::Stream::encodeAll() {
    const auto picture = makePicture(*encoder);
    const Owned<AVPacket> packet(av_packet_alloc());
    const auto write = [&](AVPacket& ready) { file.write(ready); };
    std::array<std::optional<FrameConverter>, 5> converters;  // by channels
    Pixels pixels;
    for (std::int64_t number = 0; queue.pop(pixels); ++number) {
        auto& converter = converters.at(static_cast<std::size_t>(pixels.channels));
        if (!converter) converter.emplace(pixels.width, pixels.height, pixels.channels);
        // The encoder still looks at its last frames: this gives a new picture if it holds ours.
        check(av_frame_make_writable(picture.get()), "video: allocating a picture");
        converter->convert(pixels, *picture);
        used.giveBack(std::move(pixels));
        encodePicture(*encoder, *picture, number, *packet, write);
    }
    encodeRest(*encoder, *packet, write);
}

VideoRecorder::VideoRecorder(std::string path, int width, int height, int framesPerSecond,
                             const std::vector<std::string>& encoders, int compression)
    : stream_(std::make_unique<Stream>(std::move(path), width, height, framesPerSecond, encoders,
                                       compression)) {}

VideoRecorder::~VideoRecorder() {
    if (stream_->released) return;
    try {
        stream_->handRest();
    } catch (...) {
    }
    try {
        stream_->finishWorker();
    } catch (...) {
    }
    stream_->frameCount == 0 ? stream_->file.remove() : stream_->file.leavePart();
}

void VideoRecorder::captureFrame() {
    if (stream_->released) throw std::logic_error("captureFrame: the recording was released");
    if (glCheckFramebufferStatus(GL_READ_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::logic_error("captureFrame: no framebuffer is bound for reading");
    if (!stream_->reader)
        stream_->reader.emplace(stream_->encoder->width, stream_->encoder->height);
    captureDrawn(*stream_->reader, stream_->arriving,
                 [&](Pixels& pixels) { stream_->hand(pixels); });
    ++stream_->frameCount;
}

void VideoRecorder::captureFrame(const Frame& frame) {
    if (stream_->released) throw std::logic_error("captureFrame: the recording was released");
    const AVCodecContext& encoder = *stream_->encoder;
    Pixels pixels = stream_->used.take();
    pixels.resize(encoder.width, encoder.height, 3);
    pixels.bottomUp = false;
    if (frame.width != encoder.width || frame.height != encoder.height ||
        frame.rgb.size() != pixels.bytes.size())
        throw std::invalid_argument("captureFrame: the frame is " + std::to_string(frame.width) +
                                    "x" + std::to_string(frame.height) + ", the recorder " +
                                    std::to_string(encoder.width) + "x" +
                                    std::to_string(encoder.height));
    stream_->handRest();  // what was drawn before comes before
    std::memcpy(pixels.bytes.data(), frame.rgb.data(), pixels.bytes.size());
    stream_->hand(pixels);
    stream_->used.giveBack(std::move(pixels));
    ++stream_->frameCount;
}

void VideoRecorder::release() {
    if (stream_->released) return;
    if (stream_->frameCount == 0) {
        stream_->released = true;
        stream_->queue.close();
        stream_->worker.join();
        stream_->file.remove();
        throw InputError("video '" + stream_->file.path() +
                         "' was not written: no frame was recorded; record at least one");
    }
    stream_->handRest();
    stream_->finishWorker();
    stream_->released = true;
    stream_->file.complete();
}

std::string VideoRecorder::encoderName() const { return stream_->encoder->codec->name; }

std::string VideoRecorder::notice() const {
    if (encoderName() == "libx264") return {};
    return "libx264 does not work here: recording with " + encoderName() +
           ", whose files are larger or look worse; install a libavcodec with libx264";
}

int VideoRecorder::frameCount() const { return stream_->frameCount; }

}  // namespace ballpit
