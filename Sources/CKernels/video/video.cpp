#include "ck_video.h"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "core/guard.h"
#include "image/buffers.h"
#include "video/color.h"
#include "video/ffmpeg.h"

#ifdef CK_HAS_FFMPEG

namespace ck {
namespace {

const FFmpeg& functions() {
  const FFmpeg* loaded = ffmpeg();
  if (!loaded) throw std::runtime_error("the libraries of FFmpeg are not installed");
  return *loaded;
}

/// What libavformat may read: a file can't make it open others, as playlists do.
constexpr const char* kContainers = "mov,matroska,avi,mpegts,mpeg";

/// Throws with FFmpeg's description of an error; damaged sizes make it report a lack of memory,
/// too.
void check(int result) {
  if (result >= 0) return;
  char message[AV_ERROR_MAX_STRING_SIZE] = "";
  functions().av_strerror(result, message, sizeof(message));
  throw std::runtime_error(message);
}

struct CloseInput {
  void operator()(AVFormatContext* input) const { functions().avformat_close_input(&input); }
};
struct FreeCodec {
  void operator()(AVCodecContext* codec) const { functions().avcodec_free_context(&codec); }
};
struct FreePacket {
  void operator()(AVPacket* packet) const { functions().av_packet_free(&packet); }
};
struct FreeFrame {
  void operator()(AVFrame* frame) const { functions().av_frame_free(&frame); }
};

std::unique_ptr<AVFormatContext, CloseInput> open(const std::string& path) {
  AVDictionary* options = nullptr;
  check(functions().av_dict_set(&options, "format_whitelist", kContainers, 0));
  AVFormatContext* input = nullptr;
  // The protocol keeps names such as "concat:a" from being taken for something else.
  const int result =
      functions().avformat_open_input(&input, ("file:" + path).c_str(), nullptr, &options);
  functions().av_dict_free(&options);
  check(result);
  std::unique_ptr<AVFormatContext, CloseInput> owner(input);
  check(functions().avformat_find_stream_info(input, nullptr));
  return owner;
}

/// Quarter turns clockwise that rotate the frames upright.
int rotation(const AVStream& stream) {
  const uint8_t* matrix = nullptr;
#if LIBAVFORMAT_VERSION_MAJOR >= 61
  const AVCodecParameters& parameters = *stream.codecpar;
  for (int i = 0; i < parameters.nb_coded_side_data; ++i) {
    const AVPacketSideData& data = parameters.coded_side_data[i];
    if (data.type == AV_PKT_DATA_DISPLAYMATRIX && data.size >= 9 * 4) matrix = data.data;
  }
#else
  for (int i = 0; i < stream.nb_side_data; ++i) {
    const AVPacketSideData& data = stream.side_data[i];
    if (data.type == AV_PKT_DATA_DISPLAYMATRIX && data.size >= 9 * 4) matrix = data.data;
  }
#endif
  if (!matrix) return 0;
  const double degrees =
      functions().av_display_rotation_get(reinterpret_cast<const int32_t*>(matrix));
  if (!std::isfinite(degrees)) return 0;
  return static_cast<int>(((std::lround(-degrees / 90) % 4) + 4) % 4);
}

double number(AVRational value) {
  return value.num > 0 && value.den > 0 ? static_cast<double>(value.num) / value.den : 0;
}

}  // namespace

/// A file and the decoder of its video stream.
class Video {
 public:
  Video(const std::string& path, const ck_decode_limits& limits, int threads)
      : input_(open(path)),
        packet_(functions().av_packet_alloc()),
        frame_(functions().av_frame_alloc()) {
    if (!packet_ || !frame_) throw std::bad_alloc();
    const AVCodec* decoder = nullptr;
    const int index =
        functions().av_find_best_stream(input_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
    if (index == AVERROR_STREAM_NOT_FOUND) throw std::runtime_error("it contains no video");
    if (index == AVERROR_DECODER_NOT_FOUND || (index >= 0 && !decoder)) {
      throw std::runtime_error(
          "its video is in a format that can't be decoded; convert it to H.264");
    }
    check(index);
    stream_ = input_->streams[index];
    require_within(limits, stream_->codecpar->width, stream_->codecpar->height);
    codec_.reset(functions().avcodec_alloc_context3(decoder));
    if (!codec_) throw std::bad_alloc();
    check(functions().avcodec_parameters_to_context(codec_.get(), stream_->codecpar));
    codec_->thread_count = threads;
    codec_->max_pixels = limits.maximum_pixels;
    check(functions().avcodec_open2(codec_.get(), decoder, nullptr));
  }

  ck_video_info info() const {
    AVFormatContext* input = input_.get();
    ck_video_info info{};
    info.width = codec_->width;
    info.height = codec_->height;
    info.rotation = rotation(*stream_);
    const double aspect = number(functions().av_guess_sample_aspect_ratio(input, stream_, nullptr));
    info.pixel_aspect = aspect > 0 ? aspect : 1;
    info.seconds = input->duration > 0 ? static_cast<double>(input->duration) / AV_TIME_BASE : 0;
    info.frame_rate = number(functions().av_guess_frame_rate(input, stream_, nullptr));
    return info;
  }

  /// Decodes the next frame that is intact; returns false at the end.
  bool next() {
    while (true) {
      const int result = functions().avcodec_receive_frame(codec_.get(), frame_.get());
      if (result == AVERROR_EOF) return false;
      if (result == AVERROR(ENOMEM)) check(result);
      if (result == AVERROR(EAGAIN)) {
        feed();
      } else if (result >= 0 && is_intact()) {
        return true;
      }
    }
  }

  double seconds() const {
    const int64_t time = frame_->best_effort_timestamp;
    if (time == AV_NOPTS_VALUE) return 0;
    const int64_t start = stream_->start_time == AV_NOPTS_VALUE ? 0 : stream_->start_time;
    return static_cast<double>(time - start) * number(stream_->time_base);
  }

  const AVFrame& frame() const { return *frame_; }

  const AVPixFmtDescriptor& format() const {
    const AVPixFmtDescriptor* format =
        functions().av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame_->format));
    if (!format) throw std::runtime_error("its pixel format is unknown");
    return *format;
  }

  const char* metadata(const char* key) const {
    for (const AVDictionary* list : {input_->metadata, stream_->metadata}) {
      const AVDictionaryEntry* entry = functions().av_dict_get(list, key, nullptr, 0);
      if (entry) return entry->value;
    }
    return nullptr;
  }

 private:
  /// Hands the next packet of the stream to the decoder, or the end of the file: an error of the
  /// file counts as its end, a damaged packet is passed over.
  void feed() {
    while (true) {
      const int result = functions().av_read_frame(input_.get(), packet_.get());
      if (result == AVERROR(ENOMEM)) check(result);
      const bool is_end = result < 0;
      const bool is_wanted = is_end || packet_->stream_index == stream_->index;
      const int sent = is_wanted ? functions().avcodec_send_packet(codec_.get(),
                                                                   is_end ? nullptr : packet_.get())
                                 : 0;
      functions().av_packet_unref(packet_.get());
      if (sent == AVERROR(ENOMEM)) check(sent);
      if (is_wanted) return;
    }
  }

  bool is_intact() const {
    return !(frame_->flags & AV_FRAME_FLAG_CORRUPT) && frame_->decode_error_flags == 0 &&
           frame_->width == codec_->width && frame_->height == codec_->height;
  }

  std::unique_ptr<AVFormatContext, CloseInput> input_;
  std::unique_ptr<AVCodecContext, FreeCodec> codec_;
  std::unique_ptr<AVPacket, FreePacket> packet_;
  std::unique_ptr<AVFrame, FreeFrame> frame_;
  AVStream* stream_ = nullptr;
};

}  // namespace ck

struct ck_video {
  ck::Video content;
};

ck_status ck_video_open(const char* path, const ck_decode_limits* limits, int32_t threads,
                        ck_video** video, ck_video_info* info) {
  return ck::guarded([&] {
    auto opened = std::make_unique<ck_video>(ck_video{ck::Video(path, *limits, threads)});
    *info = opened->content.info();
    *video = opened.release();
  });
}

ck_status ck_video_next(ck_video* video, double* seconds, bool* is_end) {
  return ck::guarded([&] {
    *is_end = !video->content.next();
    *seconds = *is_end ? 0 : video->content.seconds();
  });
}

ck_status ck_video_brightness(ck_video* video, const ck_mutable_pixels* destination) {
  return ck::guarded([&] {
    ck::require(destination->channels == 1 && destination->width > 0 && destination->height > 0,
                "the destination is not gray");
    ck::average_brightness(video->content.frame(), video->content.format(), *destination);
  });
}

ck_status ck_video_colors(ck_video* video, const ck_mutable_pixels* destination) {
  return ck::guarded(
      [&] { ck::convert_to_srgb(video->content.frame(), video->content.format(), *destination); });
}

const char* ck_video_metadata(const ck_video* video, const char* key) {
  return video->content.metadata(key);
}

void ck_video_free(ck_video* video) { delete video; }

#else

struct ck_video {};

ck_status ck_video_open(const char*, const ck_decode_limits*, int32_t, ck_video**, ck_video_info*) {
  return ck::guarded([] {
    throw std::runtime_error("this program was built without the libraries that read videos");
  });
}

ck_status ck_video_next(ck_video*, double*, bool* is_end) {
  *is_end = true;
  return ck_ok;
}

ck_status ck_video_brightness(ck_video*, const ck_mutable_pixels*) { return ck_ok; }
ck_status ck_video_colors(ck_video*, const ck_mutable_pixels*) { return ck_ok; }
const char* ck_video_metadata(const ck_video*, const char*) { return nullptr; }
void ck_video_free(ck_video*) {}

#endif
