// Containers: their names, their headers, and what becomes of them when something goes wrong.
#include "09_video_recording/video_file.h"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include "09_video_recording/encoder.h"
#include "09_video_recording/stream_copy.h"
#include "common/error.h"

namespace ballpit {

namespace fs = std::filesystem;

using libav::check;

namespace {

fs::path withWord(const fs::path& path, const std::string& word) {
    fs::path changed = path;
    return changed.replace_filename(path.stem().string() + word + path.extension().string());
}

std::string endingOf(const fs::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

}  // namespace

void checkVideoPath(const fs::path& path) {
    const std::string ending = endingOf(path);
    if (ending != ".mp4" && ending != ".mkv" && ending != ".mov" && ending != ".avi")
        throw InputError("video '" + path.string() + "': the name's ending '" + ending +
                         "' is no known format; end it in .mp4, .mkv, .mov or .avi");
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder))
        throw InputError("video '" + path.string() + "': there is no folder '" + folder.string() +
                         "'; create it or name another");
    if (fs::is_directory(path))
        throw InputError("video '" + path.string() + "': this is a folder; name a file");
}

VideoFile::VideoFile(fs::path path) : path_(std::move(path)), part_(withWord(path_, ".part")) {
    AVFormatContext* context = nullptr;
    check(avformat_alloc_output_context2(&context, nullptr, nullptr, part_.c_str()),
          "video: choosing the format of '" + path_.string() + "'");
    file_.reset(context);
}

bool VideoFile::isFragmented() const {
    const std::string ending = endingOf(path_);
    return ending == ".mp4" || ending == ".mov";
}

void VideoFile::open(const AVCodecContext& encoder) {
    openPart();
    try {
        writeHeader(encoder);
    } catch (...) {
        remove();
        throw;
    }
}

void VideoFile::openPart() {
    const int result = avio_open(&file_->pb, part_.c_str(), AVIO_FLAG_WRITE);
    if (result < 0)
        throw InputError("cannot write the video '" + path_.string() +
                         "': " + libav::wordsFor(result) +
                         "; name a file in a folder that you may write to");
}

void VideoFile::writeHeader(const AVCodecContext& encoder) {
    encoderUnit_ = encoder.time_base;
    AVStream* stream = avformat_new_stream(file_.get(), nullptr);
    check(avcodec_parameters_from_context(stream->codecpar, &encoder),
          "video: describing the video");
    stream->time_base = encoder.time_base;  // the format may choose a finer one
    stream->avg_frame_rate = stream->r_frame_rate = encoder.framerate;
    file_->flags |= AVFMT_FLAG_FLUSH_PACKETS;  // what is written survives the process
    AVDictionary* options = nullptr;
    if (isFragmented())
        av_dict_set(&options, "movflags", "+frag_every_frame+empty_moov+default_base_moof", 0);
    av_dict_set(&options, "cluster_time_limit", "200", 0);  // ms that MKV keeps back; others: none
    const int result = avformat_write_header(file_.get(), &options);
    av_dict_free(&options);
    if (result < 0 || file_->pb->error < 0)
        throw InputError("cannot write the video '" + path_.string() +
                         "': " + libav::wordsFor(result < 0 ? result : file_->pb->error) +
                         "; make room, or name a file elsewhere");
    headerBytes_ = safeBytes_ = avio_tell(file_->pb);
}

void VideoFile::write(AVPacket& packet) {
    stampPacket(packet, encoderUnit_, file_->streams[0]->time_base);
    packet.stream_index = 0;
    const int result = av_interleaved_write_frame(file_.get(), &packet);
    if (result >= 0) {
        safeBytes_ = avio_tell(file_->pb);
        return;
    }
    cutToWhatPlays();
    throw InputError("cannot write the video '" + path_.string() + "': " + libav::wordsFor(result) +
                     "; " + whatIsLeft() + "; make room and record again");
}

void VideoFile::cutToWhatPlays() noexcept {
    file_.reset();
    std::error_code ignored;
    if (safeBytes_ > headerBytes_)
        fs::resize_file(part_, static_cast<std::uintmax_t>(safeBytes_), ignored);
    else
        fs::remove(part_, ignored);
}

std::string VideoFile::whatIsLeft() const {
    return safeBytes_ > headerBytes_
               ? "what was recorded until then plays: '" + part_.string() + "'"
               : "no frame was recorded yet";
}

void VideoFile::finishPart() {
    int result = av_write_trailer(file_.get());
    const int closed = avio_closep(&file_->pb);
    if (result >= 0) result = closed;
    file_.reset();
    if (result < 0)
        throw InputError("cannot complete the video '" + path_.string() +
                         "': " + libav::wordsFor(result) + "; " + whatIsLeft() +
                         "; make room and record again");
}

void VideoFile::complete() {
    finishPart();
    fs::path finished = part_;
    if (isFragmented()) {
        finished = withWord(path_, ".plain.part");
        std::error_code ignored;
        try {
            copyStream(part_, finished);
        } catch (const std::exception& error) {
            fs::remove(finished, ignored);
            throw InputError("cannot give the video '" + path_.string() + "' its final form: " +
                             error.what() + "; all of it is in '" + part_.string() +
                             "' and plays; make room for a second copy and record again, or "
                             "rename it");
        }
        fs::remove(part_, ignored);
    }
    std::error_code error;
    fs::rename(finished, path_, error);
    if (error)
        throw std::runtime_error("video: naming '" + finished.string() + "' '" + path_.string() +
                                 "' failed: " + error.message());
}

void VideoFile::leavePart() noexcept {
    if (!file_) return;
    try {
        finishPart();
    } catch (...) {  // an index less: what was written plays without it
    }
}

void VideoFile::remove() noexcept {
    file_.reset();
    std::error_code ignored;
    fs::remove(part_, ignored);
}

}  // namespace ballpit
