// swift-format-ignore-file: AlwaysUseLowerCamelCase
import CoreFoundationTypes

// Keys of image properties and options.

/// The width in pixels, as stored.
public let kCGImagePropertyPixelWidth: CFString = "PixelWidth"
/// The height in pixels, as stored.
public let kCGImagePropertyPixelHeight: CFString = "PixelHeight"
/// The orientation of the stored pixels: the raw value of a `CGImagePropertyOrientation`.
public let kCGImagePropertyOrientation: CFString = "Orientation"
/// The number of bits per component after decoding.
public let kCGImagePropertyDepth: CFString = "Depth"
/// The color model.
public let kCGImagePropertyColorModel: CFString = "ColorModel"
/// Red, green and blue.
public let kCGImagePropertyColorModelRGB: CFString = "RGB"
/// Gray.
public let kCGImagePropertyColorModelGray: CFString = "Gray"
/// Whether the image has an alpha channel; absent if it has none.
public let kCGImagePropertyHasAlpha: CFString = "HasAlpha"
/// The size of the file in bytes.
public let kCGImagePropertyFileSize: CFString = "FileSize"
/// The EXIF dictionary.
public let kCGImagePropertyExifDictionary: CFString = "{Exif}"
/// The TIFF dictionary: camera and software.
public let kCGImagePropertyTIFFDictionary: CFString = "{TIFF}"
/// The GPS dictionary: position of the camera.
public let kCGImagePropertyGPSDictionary: CFString = "{GPS}"

/// The camera manufacturer.
public let kCGImagePropertyTIFFMake: CFString = "Make"
/// The camera model.
public let kCGImagePropertyTIFFModel: CFString = "Model"
/// The date and time of the last change of the file.
public let kCGImagePropertyTIFFDateTime: CFString = "DateTime"
/// The software that wrote the file.
public let kCGImagePropertyTIFFSoftware: CFString = "Software"
/// The orientation of the stored pixels.
public let kCGImagePropertyTIFFOrientation: CFString = "Orientation"

/// The exposure time in seconds.
public let kCGImagePropertyExifExposureTime: CFString = "ExposureTime"
/// The f-number.
public let kCGImagePropertyExifFNumber: CFString = "FNumber"
/// The ISO speed: an array of one number.
public let kCGImagePropertyExifISOSpeedRatings: CFString = "ISOSpeedRatings"
/// The date and time at which the photo was digitized.
public let kCGImagePropertyExifDateTimeDigitized: CFString = "DateTimeDigitized"
/// The time zone of `kCGImagePropertyExifDateTimeOriginal`.
public let kCGImagePropertyExifOffsetTimeOriginal: CFString = "OffsetTimeOriginal"
/// The decimal digits of the fraction of a second of `kCGImagePropertyExifDateTimeOriginal`.
public let kCGImagePropertyExifSubsecTimeOriginal: CFString = "SubsecTimeOriginal"
/// The lens manufacturer.
public let kCGImagePropertyExifLensMake: CFString = "LensMake"
/// The lens model.
public let kCGImagePropertyExifLensModel: CFString = "LensModel"
/// The serial number of the lens.
public let kCGImagePropertyExifLensSerialNumber: CFString = "LensSerialNumber"
/// The serial number of the camera.
public let kCGImagePropertyExifBodySerialNumber: CFString = "BodySerialNumber"
/// The focal length in millimeters.
public let kCGImagePropertyExifFocalLength: CFString = "FocalLength"
/// The 35 mm equivalent focal length in millimeters.
public let kCGImagePropertyExifFocalLenIn35mmFilm: CFString = "FocalLenIn35mmFilm"
/// The date and time at which the photo was taken.
public let kCGImagePropertyExifDateTimeOriginal: CFString = "DateTimeOriginal"
/// The width in pixels as the camera recorded it.
public let kCGImagePropertyExifPixelXDimension: CFString = "PixelXDimension"
/// The height in pixels as the camera recorded it.
public let kCGImagePropertyExifPixelYDimension: CFString = "PixelYDimension"

/// The latitude in degrees, not negative.
public let kCGImagePropertyGPSLatitude: CFString = "Latitude"
/// N or S.
public let kCGImagePropertyGPSLatitudeRef: CFString = "LatitudeRef"
/// The longitude in degrees, not negative.
public let kCGImagePropertyGPSLongitude: CFString = "Longitude"
/// E or W.
public let kCGImagePropertyGPSLongitudeRef: CFString = "LongitudeRef"
/// The altitude in meters, not negative.
public let kCGImagePropertyGPSAltitude: CFString = "Altitude"
/// 0 above sea level, 1 below.
public let kCGImagePropertyGPSAltitudeRef: CFString = "AltitudeRef"

/// Option: whether decoded pixels are cached; has no effect.
public let kCGImageSourceShouldCache: CFString = "kCGImageSourceShouldCache"
/// Option: whether pixels are decoded immediately; has no effect.
public let kCGImageSourceShouldCacheImmediately: CFString = "kCGImageSourceShouldCacheImmediately"
/// Option: the maximum side of a thumbnail in pixels.
public let kCGImageSourceThumbnailMaxPixelSize: CFString = "kCGImageSourceThumbnailMaxPixelSize"
/// Option: whether thumbnails are made from the full image; they always are.
public let kCGImageSourceCreateThumbnailFromImageAlways: CFString =
  "kCGImageSourceCreateThumbnailFromImageAlways"
/// Option: whether thumbnails are made if the file has none; they always are.
public let kCGImageSourceCreateThumbnailFromImageIfAbsent: CFString =
  "kCGImageSourceCreateThumbnailFromImageIfAbsent"
/// Option: whether thumbnails are rotated upright.
public let kCGImageSourceCreateThumbnailWithTransform: CFString =
  "kCGImageSourceCreateThumbnailWithTransform"
/// Option: the quality of lossy compression from 0 to 1 (best).
public let kCGImageDestinationLossyCompressionQuality: CFString =
  "kCGImageDestinationLossyCompressionQuality"
/// Auxiliary depth map.
public let kCGImageAuxiliaryDataTypeDepth: CFString = "kCGImageAuxiliaryDataTypeDepth"
/// Auxiliary disparity map.
public let kCGImageAuxiliaryDataTypeDisparity: CFString = "kCGImageAuxiliaryDataTypeDisparity"

// Further properties that programs query.

/// Apple's maker note; always absent.
public let kCGImagePropertyMakerAppleDictionary: CFString = "{MakerApple}"
/// The horizontal resolution in pixels per inch; always absent.
public let kCGImagePropertyDPIWidth: CFString = "DPIWidth"
/// The vertical resolution in pixels per inch; always absent.
public let kCGImagePropertyDPIHeight: CFString = "DPIHeight"
/// The name of the color profile; always absent.
public let kCGImagePropertyProfileName: CFString = "ProfileName"
/// The aperture in APEX units.
public let kCGImagePropertyExifApertureValue: CFString = "ApertureValue"
/// The shutter speed in APEX units.
public let kCGImagePropertyExifShutterSpeedValue: CFString = "ShutterSpeedValue"
/// The brightness of the scene in APEX units.
public let kCGImagePropertyExifBrightnessValue: CFString = "BrightnessValue"
/// The exposure bias in APEX units.
public let kCGImagePropertyExifExposureBiasValue: CFString = "ExposureBiasValue"
/// The maximum aperture of the lens in APEX units.
public let kCGImagePropertyExifMaxApertureValue: CFString = "MaxApertureValue"
/// The distance of the subject in meters.
public let kCGImagePropertyExifSubjectDistance: CFString = "SubjectDistance"
/// The metering mode.
public let kCGImagePropertyExifMeteringMode: CFString = "MeteringMode"
/// The light source.
public let kCGImagePropertyExifLightSource: CFString = "LightSource"
/// Whether and how the flash fired.
public let kCGImagePropertyExifFlash: CFString = "Flash"
/// The white balance mode.
public let kCGImagePropertyExifWhiteBalance: CFString = "WhiteBalance"
/// The exposure mode.
public let kCGImagePropertyExifExposureMode: CFString = "ExposureMode"
/// The exposure program.
public let kCGImagePropertyExifExposureProgram: CFString = "ExposureProgram"
/// The color space: 1 for sRGB.
public let kCGImagePropertyExifColorSpace: CFString = "ColorSpace"
/// The digital zoom ratio.
public let kCGImagePropertyExifDigitalZoomRatio: CFString = "DigitalZoomRatio"
/// The scene type.
public let kCGImagePropertyExifSceneCaptureType: CFString = "SceneCaptureType"
/// A comment of the user; always absent.
public let kCGImagePropertyExifUserComment: CFString = "UserComment"
/// The author of the image.
public let kCGImagePropertyTIFFArtist: CFString = "Artist"
/// The copyright holder.
public let kCGImagePropertyTIFFCopyright: CFString = "Copyright"
/// The GPS time; always absent.
public let kCGImagePropertyGPSTimeStamp: CFString = "TimeStamp"
/// The GPS date; always absent.
public let kCGImagePropertyGPSDateStamp: CFString = "DateStamp"
/// The viewing direction in degrees; always absent.
public let kCGImagePropertyGPSImgDirection: CFString = "ImgDirection"
/// The reference of the direction, true or magnetic north; always absent.
public let kCGImagePropertyGPSImgDirectionRef: CFString = "ImgDirectionRef"
