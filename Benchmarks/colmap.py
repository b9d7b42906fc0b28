#!/usr/bin/env python3
"""Aligns the photos of a folder with COLMAP (pycolmap): default options, one camera.

    colmap.py IMAGES RESULT

The largest model is written to RESULT/sparse.
"""

import shutil
import sys
from pathlib import Path

import pycolmap

images, result = Path(sys.argv[1]), Path(sys.argv[2])
result.mkdir(parents=True, exist_ok=True)
database = result / "database.db"
pycolmap.extract_features(database, images, camera_mode=pycolmap.CameraMode.SINGLE)
pycolmap.match_exhaustive(database)
(result / "models").mkdir(exist_ok=True)
models = pycolmap.incremental_mapping(database, images, result / "models")
if not models:
    sys.exit("no model")
best = max(models.values(), key=lambda model: model.num_reg_images())
(result / "sparse").mkdir(exist_ok=True)
best.write_binary(result / "sparse")
shutil.rmtree(result / "models")
database.unlink()
