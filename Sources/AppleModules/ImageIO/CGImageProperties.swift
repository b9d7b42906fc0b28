// swift-format-ignore-file: AlwaysUseLowerCamelCase
import CoreFoundationTypes

// Names of what is known of an image, and of options.

/// The width in pixels, as stored.
public let kCGImagePropertyPixelWidth: CFString = "PixelWidth"
/// The height in pixels, as stored.
public let kCGImagePropertyPixelHeight: CFString = "PixelHeight"
/// How the pixels are to be turned: a `CGImagePropertyOrientation`.
public let kCGImagePropertyOrientation: CFString = "Orientation"
/// The bits of a component, once read.
public let kCGImagePropertyDepth: CFString = "Depth"
/// The kind of colours.
public let kCGImagePropertyColorModel: CFString = "ColorModel"
/// Red, green and blue.
public let kCGImagePropertyColorModelRGB: CFString = "RGB"
/// Gray.
public let kCGImagePropertyColorModelGray: CFString = "Gray"
/// Whether pixels have an opacity; left out where they don't.
public let kCGImagePropertyHasAlpha: CFString = "HasAlpha"
/// The bytes of the file.
public let kCGImagePropertyFileSize: CFString = "FileSize"
/// What the camera wrote.
public let kCGImagePropertyExifDictionary: CFString = "{Exif}"
/// What the camera wrote about itself.
public let kCGImagePropertyTIFFDictionary: CFString = "{TIFF}"
/// Where the photo was taken.
public let kCGImagePropertyGPSDictionary: CFString = "{GPS}"

/// Who made the camera.
public let kCGImagePropertyTIFFMake: CFString = "Make"
/// The camera.
public let kCGImagePropertyTIFFModel: CFString = "Model"
/// When the file was changed.
public let kCGImagePropertyTIFFDateTime: CFString = "DateTime"
/// What wrote the file.
public let kCGImagePropertyTIFFSoftware: CFString = "Software"
/// How the pixels are to be turned.
public let kCGImagePropertyTIFFOrientation: CFString = "Orientation"

/// How long the photo was exposed, in seconds.
public let kCGImagePropertyExifExposureTime: CFString = "ExposureTime"
/// The aperture.
public let kCGImagePropertyExifFNumber: CFString = "FNumber"
/// How sensitive the sensor was: an array of one number.
public let kCGImagePropertyExifISOSpeedRatings: CFString = "ISOSpeedRatings"
/// When the photo was stored.
public let kCGImagePropertyExifDateTimeDigitized: CFString = "DateTimeDigitized"
/// The time zone of `kCGImagePropertyExifDateTimeOriginal`.
public let kCGImagePropertyExifOffsetTimeOriginal: CFString = "OffsetTimeOriginal"
/// The fraction of a second of `kCGImagePropertyExifDateTimeOriginal`: its digits.
public let kCGImagePropertyExifSubsecTimeOriginal: CFString = "SubsecTimeOriginal"
/// Who made the lens.
public let kCGImagePropertyExifLensMake: CFString = "LensMake"
/// The lens.
public let kCGImagePropertyExifLensModel: CFString = "LensModel"
/// The serial number of the lens.
public let kCGImagePropertyExifLensSerialNumber: CFString = "LensSerialNumber"
/// The serial number of the camera.
public let kCGImagePropertyExifBodySerialNumber: CFString = "BodySerialNumber"
/// The focal length in millimetres.
public let kCGImagePropertyExifFocalLength: CFString = "FocalLength"
/// The focal length on 35 mm film.
public let kCGImagePropertyExifFocalLenIn35mmFilm: CFString = "FocalLenIn35mmFilm"
/// When the photo was taken.
public let kCGImagePropertyExifDateTimeOriginal: CFString = "DateTimeOriginal"
/// The width as the camera wrote it.
public let kCGImagePropertyExifPixelXDimension: CFString = "PixelXDimension"
/// The height as the camera wrote it.
public let kCGImagePropertyExifPixelYDimension: CFString = "PixelYDimension"

/// Degrees from the equator.
public let kCGImagePropertyGPSLatitude: CFString = "Latitude"
/// N or S.
public let kCGImagePropertyGPSLatitudeRef: CFString = "LatitudeRef"
/// Degrees from Greenwich.
public let kCGImagePropertyGPSLongitude: CFString = "Longitude"
/// E or W.
public let kCGImagePropertyGPSLongitudeRef: CFString = "LongitudeRef"
/// Metres from the sea.
public let kCGImagePropertyGPSAltitude: CFString = "Altitude"
/// 0 above the sea, 1 below.
public let kCGImagePropertyGPSAltitudeRef: CFString = "AltitudeRef"

/// Option: whether pixels are kept; has no effect.
public let kCGImageSourceShouldCache: CFString = "kCGImageSourceShouldCache"
/// Option: whether pixels are read at once; has no effect.
public let kCGImageSourceShouldCacheImmediately: CFString = "kCGImageSourceShouldCacheImmediately"
/// Option: the longer side of a thumbnail.
public let kCGImageSourceThumbnailMaxPixelSize: CFString = "kCGImageSourceThumbnailMaxPixelSize"
/// Option: whether thumbnails are made from the image; they always are.
public let kCGImageSourceCreateThumbnailFromImageAlways: CFString =
  "kCGImageSourceCreateThumbnailFromImageAlways"
/// Option: whether thumbnails are made where the file has none; they always are.
public let kCGImageSourceCreateThumbnailFromImageIfAbsent: CFString =
  "kCGImageSourceCreateThumbnailFromImageIfAbsent"
/// Option: whether thumbnails are turned upright.
public let kCGImageSourceCreateThumbnailWithTransform: CFString =
  "kCGImageSourceCreateThumbnailWithTransform"
/// Option: the quality of a JPEG, from 0 to 1, best.
public let kCGImageDestinationLossyCompressionQuality: CFString =
  "kCGImageDestinationLossyCompressionQuality"
/// Depths that come with an image.
public let kCGImageAuxiliaryDataTypeDepth: CFString = "kCGImageAuxiliaryDataTypeDepth"
/// Disparities that come with an image.
public let kCGImageAuxiliaryDataTypeDisparity: CFString = "kCGImageAuxiliaryDataTypeDisparity"

// Properties that programs ask for. Those that numbers tell of are read, the others are never there.

/// What Apple's cameras note; never there.
public let kCGImagePropertyMakerAppleDictionary: CFString = "{MakerApple}"
/// Pixels an inch, across; never there.
public let kCGImagePropertyDPIWidth: CFString = "DPIWidth"
/// Pixels an inch, down; never there.
public let kCGImagePropertyDPIHeight: CFString = "DPIHeight"
/// The name of the colour profile; never there.
public let kCGImagePropertyProfileName: CFString = "ProfileName"
/// The aperture as an exponent.
public let kCGImagePropertyExifApertureValue: CFString = "ApertureValue"
/// The exposure time as an exponent.
public let kCGImagePropertyExifShutterSpeedValue: CFString = "ShutterSpeedValue"
/// The brightness of the scene.
public let kCGImagePropertyExifBrightnessValue: CFString = "BrightnessValue"
/// By how much the exposure was changed.
public let kCGImagePropertyExifExposureBiasValue: CFString = "ExposureBiasValue"
/// The widest aperture of the lens.
public let kCGImagePropertyExifMaxApertureValue: CFString = "MaxApertureValue"
/// The distance in metres.
public let kCGImagePropertyExifSubjectDistance: CFString = "SubjectDistance"
/// How light was measured.
public let kCGImagePropertyExifMeteringMode: CFString = "MeteringMode"
/// The kind of light.
public let kCGImagePropertyExifLightSource: CFString = "LightSource"
/// Whether there was a flash.
public let kCGImagePropertyExifFlash: CFString = "Flash"
/// How colours were balanced.
public let kCGImagePropertyExifWhiteBalance: CFString = "WhiteBalance"
/// How the exposure was chosen.
public let kCGImagePropertyExifExposureMode: CFString = "ExposureMode"
/// By which program the exposure was chosen.
public let kCGImagePropertyExifExposureProgram: CFString = "ExposureProgram"
/// The colour space: 1 for sRGB.
public let kCGImagePropertyExifColorSpace: CFString = "ColorSpace"
/// By how much the image was enlarged.
public let kCGImagePropertyExifDigitalZoomRatio: CFString = "DigitalZoomRatio"
/// The kind of scene.
public let kCGImagePropertyExifSceneCaptureType: CFString = "SceneCaptureType"
/// A remark.
public let kCGImagePropertyExifUserComment: CFString = "UserComment"
/// Who made the image.
public let kCGImagePropertyTIFFArtist: CFString = "Artist"
/// Whose image it is.
public let kCGImagePropertyTIFFCopyright: CFString = "Copyright"
/// The time by satellite.
public let kCGImagePropertyGPSTimeStamp: CFString = "TimeStamp"
/// The day by satellite.
public let kCGImagePropertyGPSDateStamp: CFString = "DateStamp"
/// Where the camera looked, in degrees.
public let kCGImagePropertyGPSImgDirection: CFString = "ImgDirection"
/// From which north directions count.
public let kCGImagePropertyGPSImgDirectionRef: CFString = "ImgDirectionRef"
