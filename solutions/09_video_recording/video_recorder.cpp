// Convert, encode, write: each frame goes from RGB to YUV to a compressed packet to the file.
#include "09_video_recording/video_recorder.h"

#include "common/error.h"
#include "common/libav.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <utility>

extern "C" {
#include <libavutil/opt.h>
}

namespace ballpit {
namespace {

namespace fs = std::filesystem;

using libav::check;
using libav::Owned;

// ---- What the user asked for

void checkExtension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const char* good : {".mp4", ".mkv", ".mov", ".avi"})
        if (extension == good) return;
    throw InputError("video '" + path.string() + "': the name's ending '" + extension +
                     "' is no known format; end it in .mp4, .mkv, .mov or .avi");
}

void checkSize(int width, int height) {
    const std::string asked = std::to_string(width) + "x" + std::to_string(height);
    if (width < 1 || height < 1)
        throw InputError("video size " + asked + ": width and height must be at least 2");
    if (width % 2 == 0 && height % 2 == 0) return;
    const auto even = [](int size) { return std::to_string(std::max(2, size - size % 2)); };
    throw InputError("video size " + asked + ": H.264 needs an even width and height; use " +
                     even(width) + "x" + even(height));
}

void checkPlace(const fs::path& path) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder))
        throw InputError("video '" + path.string() + "': there is no folder '" + folder.string() +
                         "'; create it or name another");
    if (fs::is_directory(path))
        throw InputError("video '" + path.string() + "': this is a folder; name a file");
}

fs::path partName(const fs::path& path) {
    fs::path part = path;
    return part.replace_filename(path.stem().string() + ".part" + path.extension().string());
}

// ---- The encoder

void chooseQuality(AVCodecContext& encoder) {
    if (std::string(encoder.codec->name) == "libx264") {
        // 10 ms a frame at 1920x1080 with 500 balls on two cores; finer presets take longer.
        av_opt_set(encoder.priv_data, "preset", "veryfast", 0);
        av_opt_set(encoder.priv_data, "crf", "20", 0);
    } else if (encoder.codec_id == AV_CODEC_ID_MPEG4) {
        encoder.flags |= AV_CODEC_FLAG_QSCALE;
        encoder.global_quality = 3 * FF_QP2LAMBDA;
    } else {
        encoder.bit_rate = encoder.width * std::int64_t{encoder.height} * encoder.framerate.num / 6;
    }
}

/// Hardware encoders are left out: they want a device and other picture formats.
bool isUsable(const AVCodec& codec) {
    if (codec.capabilities & (AV_CODEC_CAP_HARDWARE | AV_CODEC_CAP_HYBRID)) return false;
    for (const AVPixelFormat* format = codec.pix_fmts; format && *format != AV_PIX_FMT_NONE;
         ++format)
        if (*format == AV_PIX_FMT_YUV420P) return true;
    return false;
}

/// An open encoder of that name; null if this machine has none that works.
Owned<AVCodecContext> tryEncoder(const std::string& name, int width, int height,
                                 int framesPerSecond, const AVOutputFormat& format) {
    const AVCodec* codec = avcodec_find_encoder_by_name(name.c_str());
    if (!codec) return nullptr;
    Owned<AVCodecContext> encoder(avcodec_alloc_context3(codec));
    encoder->width = width;
    encoder->height = height;
    encoder->pix_fmt = AV_PIX_FMT_YUV420P;
    encoder->time_base = {1, framesPerSecond};
    encoder->framerate = {framesPerSecond, 1};
    encoder->gop_size = 2 * framesPerSecond;  // players can jump to any two seconds
    encoder->sample_aspect_ratio = {1, 1};
    encoder->color_range = AVCOL_RANGE_MPEG;
    encoder->colorspace = AVCOL_SPC_BT709;
    encoder->color_primaries = AVCOL_PRI_BT709;
    encoder->color_trc = AVCOL_TRC_BT709;
    if (format.flags & AVFMT_GLOBALHEADER) encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    // AVI stores no display times, so its frames must come in the order in which they are shown.
    if (std::string(format.name) == "avi") encoder->max_b_frames = 0;
    chooseQuality(*encoder);
    return avcodec_open2(encoder.get(), codec, nullptr) >= 0 ? std::move(encoder) : nullptr;
}

Owned<AVCodecContext> openEncoder(const std::vector<std::string>& names, int width, int height,
                                  int framesPerSecond, const AVOutputFormat& format) {
    for (const std::string& name : names)
        if (auto encoder = tryEncoder(name, width, height, framesPerSecond, format)) return encoder;
    throw InputError("video: no encoder here can record " + std::to_string(width) + "x" +
                     std::to_string(height) + "; install ffmpeg with libx264");
}

// ---- Converting

/// RGB to YUV as HD video defines it (BT.709, luma from 16 to 235).
Owned<SwsContext> makeConverter(int width, int height) {
    Owned<SwsContext> converter(sws_getContext(width, height, AV_PIX_FMT_RGB24, width, height,
                                               AV_PIX_FMT_YUV420P, SWS_BILINEAR, nullptr, nullptr,
                                               nullptr));
    if (!converter) throw std::runtime_error("video: libswscale cannot convert RGB to YUV");
    const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
    const int full = 1, limited = 0, unity = 1 << 16;
    sws_setColorspaceDetails(converter.get(), bt709, full, bt709, limited, 0, unity, unity);
    return converter;
}

Owned<AVFrame> makePicture(const AVCodecContext& encoder) {
    Owned<AVFrame> picture(av_frame_alloc());
    picture->width = encoder.width;
    picture->height = encoder.height;
    picture->format = encoder.pix_fmt;
    picture->color_range = encoder.color_range;
    picture->colorspace = encoder.colorspace;
    check(av_frame_get_buffer(picture.get(), 0), "video: allocating a picture");
    return picture;
}

}  // namespace

std::vector<std::string> preferredEncoders() {
    std::vector<std::string> names{"libx264", "libopenh264"};
    void* position = nullptr;
    while (const AVCodec* codec = av_codec_iterate(&position))
        if (codec->id == AV_CODEC_ID_H264 && av_codec_is_encoder(codec) && isUsable(*codec) &&
            std::ranges::find(names, codec->name) == names.end())
            names.emplace_back(codec->name);
    names.emplace_back("mpeg4");
    return names;
}

struct VideoRecorder::Stream {
    fs::path path, part;
    Owned<AVFormatContext> file;
    Owned<AVCodecContext> encoder;
    Owned<SwsContext> converter;
    Owned<AVFrame> picture;
    Owned<AVPacket> packet{av_packet_alloc()};
    int frameCount = 0;
    bool trailerTried = false;

    void open(int width, int height, int framesPerSecond, const std::vector<std::string>& names);
    void openFile();
    void writeHeader();
    void encode(const AVFrame* frameOrEnd);
    void writeTrailer();
    void removePart() noexcept;
};

void VideoRecorder::Stream::open(int width, int height, int framesPerSecond,
                                 const std::vector<std::string>& names) {
    AVFormatContext* context = nullptr;
    check(avformat_alloc_output_context2(&context, nullptr, nullptr, part.c_str()),
          "video: choosing the format of '" + path.string() + "'");
    file.reset(context);
    encoder = openEncoder(names, width, height, framesPerSecond, *file->oformat);
    converter = makeConverter(width, height);
    picture = makePicture(*encoder);
    openFile();
    writeHeader();
}

void VideoRecorder::Stream::openFile() {
    const int result = avio_open(&file->pb, part.c_str(), AVIO_FLAG_WRITE);
    if (result < 0)
        throw InputError("cannot write the video '" + path.string() +
                         "': " + libav::wordsFor(result) +
                         "; name a file in a folder that you may write to");
}

void VideoRecorder::Stream::writeHeader() {
    AVStream* stream = avformat_new_stream(file.get(), nullptr);
    check(avcodec_parameters_from_context(stream->codecpar, encoder.get()),
          "video: describing the video");
    stream->time_base = encoder->time_base;  // the format may choose a finer one
    stream->avg_frame_rate = stream->r_frame_rate = encoder->framerate;
    AVDictionary* options = nullptr;
    // The index goes to the front, so that a browser can start to play before it has it all.
    av_dict_set(&options, "movflags", "+faststart", 0);
    const int result = avformat_write_header(file.get(), &options);
    av_dict_free(&options);
    check(result, "video: writing the header of '" + part.string() + "'");
}

/// Hands a picture to the encoder, or its end (null), and writes the packets that are ready: the
/// encoder looks some frames ahead, so a packet comes later than its frame.
void VideoRecorder::Stream::encode(const AVFrame* frameOrEnd) {
    check(avcodec_send_frame(encoder.get(), frameOrEnd), "video: encoding a frame");
    while (true) {
        const int result = avcodec_receive_packet(encoder.get(), packet.get());
        if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
        check(result, "video: encoding");
        packet->duration = 1;
        av_packet_rescale_ts(packet.get(), encoder->time_base, file->streams[0]->time_base);
        packet->stream_index = 0;
        check(av_interleaved_write_frame(file.get(), packet.get()),
              "video: writing '" + part.string() + "'");
    }
}

void VideoRecorder::Stream::writeTrailer() {
    if (std::exchange(trailerTried, true)) return;
    check(av_write_trailer(file.get()), "video: completing '" + part.string() + "'");
    check(avio_closep(&file->pb), "video: closing '" + part.string() + "'");
}

void VideoRecorder::Stream::removePart() noexcept {
    file.reset();
    std::error_code ignored;
    fs::remove(part, ignored);
}

VideoRecorder::VideoRecorder(std::string path, int width, int height, int framesPerSecond,
                             const std::vector<std::string>& encoders)
    : stream_(std::make_unique<Stream>()) {
    av_log_set_level(AV_LOG_ERROR);
    checkExtension(path);
    checkSize(width, height);
    if (framesPerSecond < 1)
        throw InputError("video: " + std::to_string(framesPerSecond) +
                         " frames per second; there must be at least 1 (60 is usual)");
    checkPlace(path);
    stream_->path = std::move(path);
    stream_->part = partName(stream_->path);
    try {
        stream_->open(width, height, framesPerSecond, encoders);
    } catch (...) {
        if (stream_->file && stream_->file->pb) stream_->removePart();
        throw;
    }
}

VideoRecorder::~VideoRecorder() {
    if (!stream_->file) return;
    if (stream_->frameCount == 0) {
        stream_->removePart();
        return;
    }
    // On a full disk the last frames may fail, and the trailer, which is small, succeed.
    try {
        stream_->encode(nullptr);
    } catch (...) {
    }
    try {
        stream_->writeTrailer();
    } catch (...) {
    }
}

void VideoRecorder::captureFrame(const Frame& frame) {
    if (!stream_->file) throw std::logic_error("captureFrame: the recording was released");
    const AVCodecContext& encoder = *stream_->encoder;
    const auto bytes =
        3 * static_cast<std::size_t>(encoder.width) * static_cast<std::size_t>(encoder.height);
    if (frame.width != encoder.width || frame.height != encoder.height || frame.rgb.size() != bytes)
        throw std::invalid_argument("captureFrame: the frame is " + std::to_string(frame.width) +
                                    "x" + std::to_string(frame.height) + ", the recorder " +
                                    std::to_string(encoder.width) + "x" +
                                    std::to_string(encoder.height));

    AVFrame& picture = *stream_->picture;
    // The encoder still looks at its last frames: this gives us a new picture if it holds ours.
    check(av_frame_make_writable(&picture), "video: allocating a picture");
    const std::uint8_t* rows = frame.rgb.data();
    const int rowBytes = 3 * frame.width;
    sws_scale(stream_->converter.get(), &rows, &rowBytes, 0, frame.height, picture.data,
              picture.linesize);
    picture.pts = stream_->frameCount;
    stream_->encode(&picture);
    ++stream_->frameCount;
}

void VideoRecorder::release() {
    if (!stream_->file) return;
    if (stream_->frameCount == 0) {
        stream_->removePart();
        throw InputError("video '" + stream_->path.string() +
                         "' was not written: no frame was recorded; record at least one");
    }
    stream_->encode(nullptr);
    stream_->writeTrailer();
    stream_->file.reset();
    std::error_code error;
    fs::rename(stream_->part, stream_->path, error);
    if (error)
        throw std::runtime_error("video: naming '" + stream_->part.string() + "' '" +
                                 stream_->path.string() + "' failed: " + error.message());
}

std::string VideoRecorder::encoderName() const { return stream_->encoder->codec->name; }

std::string VideoRecorder::notice() const {
    if (encoderName() == "libx264") return {};
    return "libx264 does not work here: recording with " + encoderName() +
           ", whose files are larger or look worse; install a libavcodec with libx264";
}

int VideoRecorder::frameCount() const { return stream_->frameCount; }

}  // namespace ballpit
