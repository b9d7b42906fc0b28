/// The discussion in the help of `densify`.
enum DensifyHelp {
  static let discussion = """
    Writes dense/points.ply, colored points with normals in the frame of the given cameras, and \
    report.json into the folder <output>. Needs no GPU.

    EXAMPLES
      colmap mapper --database_path db --image_path photos --output_path sparse
      colmap model_converter --input_path sparse/0 --output_path sparse/0 \\
          --output_type TXT
      photogrammetry-cli densify photos/ sparse/0/ work/
          COLMAP's cameras; undistorting the photos is not necessary.
      photogrammetry-cli align photos/ work/
      photogrammetry-cli densify photos/ work/ cloud/ -d full
          Cameras of 'align'.
      photogrammetry-cli densify photos/ rig/ work/ --metric
          Cameras of a survey or a rig, in meters.

    CAMERAS
      The folder holds, directly or in sparse/ or sparse/0/, either
      cameras.txt, images.txt and points3D.txt
          COLMAP's text format, with the camera models SIMPLE_PINHOLE, PINHOLE,
          SIMPLE_RADIAL, RADIAL and OPENCV. For other models, undistort the
          photos with 'colmap image_undistorter'. points3D.txt may be missing
          or empty: points are then triangulated with fixed poses.
      or cameras.json (directly)
          [{"name": "IMG_1.jpg", "K": [[f, 0, cx], [0, f, cy], [0, 0, 1]],
            "R": [[…], […], […]], "t": […], "width": 4000, "height": 3000}]
          where x_camera = R x_world + t, with x right, y down, z forward;
          width and height are optional and default to those of the photo.
      Cameras are matched to photos by file name. A camera for another size
      of the same aspect ratio is scaled. Pixel coordinates start at the top
      left corner of the top left pixel, in the photo rotated upright by its
      EXIF orientation, as 'align' writes them. If the size shows that a camera
      is for the photo as stored, as COLMAP's are, the camera is rotated; for a
      photo that is stored upside down the size does not show it: rotate the
      photo first.

    DETAIL LEVELS (maximum number of pixels used per photo)
      preview 0.08, reduced 0.18, medium 0.5, full 2, raw 4 megapixels

    JOBS
      --job 2/8 processes every eighth view, starting with the second, writes the
      results to <output>/dense/views/ and stops; this is most of the work. Jobs
      may run in sequence or in parallel, also on several machines that share
      <output>; they divide the preparation between them. Afterwards, the same
      command without --job makes the cloud.

    Exit codes: 0 the cloud was written, 1 the photos give no points with these cameras, \
    2 invalid arguments or paths, 130 interrupted.
    """
}
