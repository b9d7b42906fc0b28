"""Makes what people install from the static executable, the same bytes from the same input.

    archives.py <program> <licenses> <output> --commit-time SECONDS

<licenses> holds a folder with license texts for each part of the program.
"""

import argparse
import base64
import gzip
import hashlib
import io
import json
import lzma
import pathlib
import subprocess
import tarfile
import tempfile
import zipfile
from datetime import datetime, timezone

import manual

NAME = "photogrammetry-cli"
SUMMARY = "Photos in, a textured 3-D model out"
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]


class Tree:
    """Files below an installation prefix, by path."""

    def __init__(self):
        self.files: dict[str, tuple[bytes, int]] = {}

    def add(self, path, content: bytes, mode=0o644):
        self.files[path] = (content, mode)

    def folders(self):
        parents = {str(p) for path in self.files for p in pathlib.PurePosixPath(path).parents}
        return sorted(parents - {"."})

    def tar(self, time: int, prefix="", empty_folders=()) -> bytes:
        """An uncompressed tar archive with sorted names, owned by root."""
        buffer = io.BytesIO()
        with tarfile.open(fileobj=buffer, mode="w", format=tarfile.USTAR_FORMAT) as archive:
            for folder in self.folders() + list(empty_folders):
                info = tarfile.TarInfo(prefix + folder)
                info.type, info.mode, info.mtime = tarfile.DIRTYPE, 0o755, time
                if folder in empty_folders:
                    info.mode = 0o1777
                archive.addfile(info)
            for path, (content, mode) in sorted(self.files.items()):
                info = tarfile.TarInfo(prefix + path)
                info.size, info.mode, info.mtime = len(content), mode, time
                archive.addfile(info, io.BytesIO(content))
        return buffer.getvalue()


def output_of(program, *arguments) -> bytes:
    return subprocess.run([program, *arguments], check=True, capture_output=True).stdout


def compressed(content: bytes) -> bytes:
    return gzip.compress(content, 9, mtime=0)


def installed_files(program, licenses, time) -> Tree:
    """What is below /usr after installation."""
    tree = Tree()
    tree.add(f"bin/{NAME}", program.read_bytes(), 0o755)
    for shell, path in {
        "bash": f"share/bash-completion/completions/{NAME}",
        "zsh": f"share/zsh/vendor-completions/_{NAME}",
        "fish": f"share/fish/vendor_completions.d/{NAME}.fish",
    }.items():
        tree.add(path, output_of(program, "--generate-completion-script", shell))
    for page, text in manual.pages(program, time).items():
        tree.add(f"share/man/man1/{page}.1.gz", compressed(text.encode()))
    documents = f"share/doc/{NAME}"
    tree.add(f"{documents}/copyright", copyright_text(licenses))
    tree.add(f"{documents}/changelog.gz", compressed((REPOSITORY / "CHANGELOG.md").read_bytes()))
    return tree


def copyright_text(licenses) -> bytes:
    """The project's license and those of all parts of the static program."""
    parts = [(NAME, (REPOSITORY / "LICENSE").read_text())]
    for folder in sorted(licenses.iterdir()):
        texts = [file.read_text(errors="replace") for file in sorted(folder.iterdir())]
        parts.append((folder.name, "\n".join(texts)))
    rule = "=" * 80
    return "".join(f"{rule}\n{name}\n{rule}\n{text}\n" for name, text in parts).encode()


def make_tarball(tree, version, time) -> tuple[str, bytes]:
    folder = f"{NAME}-{version}-linux-x86_64"
    return f"{folder}.tar.xz", lzma.compress(tree.tar(time, folder + "/"), preset=6)


def make_deb(tree, version, time) -> tuple[str, bytes]:
    """Through dpkg-deb, whose archives are reproducible if SOURCE_DATE_EPOCH is set."""
    size = sum(len(content) for content, _ in tree.files.values())
    control = "\n".join([
        f"Package: {NAME}",
        f"Version: {version}",
        "Architecture: amd64",
        f"Maintainer: {NAME} contributors",
        f"Installed-Size: {-(-size // 1024)}",
        "Section: graphics",
        "Priority: optional",
        f"Description: {SUMMARY}",
        " Reconstructs objects and scenes from overlapping photos as USDZ, GLB, PLY or OBJ.",
        "",
    ])
    sums = "".join(
        f"{hashlib.md5(content).hexdigest()}  usr/{path}\n"
        for path, (content, _) in sorted(tree.files.items()))
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder) / "root"
        for path, (content, mode) in tree.files.items():
            target = root / "usr" / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
            target.chmod(mode)
        (root / "DEBIAN").mkdir()
        (root / "DEBIAN/control").write_text(control)
        (root / "DEBIAN/md5sums").write_text(sums)
        for path in [root, *root.rglob("*")]:
            if path.is_dir():
                path.chmod(0o755)
        package = pathlib.Path(folder) / "package.deb"
        subprocess.run(
            ["dpkg-deb", "--root-owner-group", "-Zxz", "--build", root, package], check=True,
            capture_output=True, env={"PATH": "/usr/bin:/bin", "SOURCE_DATE_EPOCH": str(time)})
        return f"{NAME}_{version}_amd64.deb", package.read_bytes()


def make_image(tree, version, time) -> tuple[str, bytes]:
    """An OCI archive (image specification 1.0) with one layer."""
    root = Tree()
    root.files = {f"usr/{path}": file for path, file in tree.files.items()}
    layer = root.tar(time, empty_folders=["tmp", "var/tmp"])
    packed = compressed(layer)
    blobs = {}

    def blob(content, media_type):
        digest = hashlib.sha256(content).hexdigest()
        blobs[f"blobs/sha256/{digest}"] = content
        return {"mediaType": media_type, "digest": f"sha256:{digest}", "size": len(content)}

    oci = "application/vnd.oci.image"
    layer_entry = blob(packed, f"{oci}.layer.v1.tar+gzip")
    created = datetime.fromtimestamp(time, timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    config = blob(json_bytes({
        "created": created, "architecture": "amd64", "os": "linux",
        "config": {
            "Entrypoint": [f"/usr/bin/{NAME}"], "Cmd": ["--help"], "WorkingDir": "/data",
            "Env": ["PATH=/usr/bin"],
            "Labels": {
                "org.opencontainers.image.title": NAME,
                "org.opencontainers.image.description": SUMMARY,
                "org.opencontainers.image.version": version,
                "org.opencontainers.image.licenses": "Apache-2.0",
            },
        },
        "rootfs": {"type": "layers", "diff_ids": ["sha256:" + hashlib.sha256(layer).hexdigest()]},
    }), f"{oci}.config.v1+json")
    manifest = blob(json_bytes({
        "schemaVersion": 2, "mediaType": f"{oci}.manifest.v1+json", "config": config,
        "layers": [layer_entry],
    }), f"{oci}.manifest.v1+json")
    # The names under which `podman load` and `docker load` store the image.
    manifest["annotations"] = {
        "org.opencontainers.image.ref.name": f"{NAME}:latest",
        "io.containerd.image.name": f"{NAME}:latest",
    }
    archive = Tree()
    archive.add("oci-layout", json_bytes({"imageLayoutVersion": "1.0.0"}))
    archive.add("index.json", json_bytes({"schemaVersion": 2, "manifests": [manifest]}))
    for path, content in blobs.items():
        archive.add(path, content)
    return f"{NAME}-{version}-oci.tar", archive.tar(time)


def json_bytes(value) -> bytes:
    return json.dumps(value, indent=1, sort_keys=True).encode()


def make_wheel(tree, version, time) -> tuple[str, bytes]:
    """A wheel (PEP 427) that puts the program into the environment's bin folder."""
    module = NAME.replace("-", "_")
    tag = "py3-none-manylinux_2_17_x86_64.manylinux2014_x86_64"
    info = f"{module}-{version}.dist-info"
    program = tree.files[f"bin/{NAME}"][0]
    files = {
        f"{module}-{version}.data/scripts/{NAME}": (program, 0o755),
        f"{info}/METADATA": ("\n".join([
            "Metadata-Version: 2.1", f"Name: {NAME}", f"Version: {version}", f"Summary: {SUMMARY}",
            "License: Apache-2.0", "License-File: LICENSES.txt", "Description-Content-Type: text/markdown",
            "", (REPOSITORY / "README.md").read_text(),
        ]).encode(), 0o644),
        f"{info}/LICENSES.txt": (tree.files[f"share/doc/{NAME}/copyright"][0], 0o644),
        f"{info}/WHEEL": ("\n".join([
            "Wheel-Version: 1.0", f"Generator: {NAME}", "Root-Is-Purelib: false",
            *[f"Tag: py3-none-{platform}" for platform in tag.split("-")[2].split(".")], "",
        ]).encode(), 0o644),
    }
    record = ""
    for path, (content, _) in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(content)}\n"
    files[f"{info}/RECORD"] = ((record + f"{info}/RECORD,,\n").encode(), 0o644)
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        date = datetime.fromtimestamp(max(time, 315532800), timezone.utc).timetuple()[:6]
        for path, (content, mode) in files.items():
            entry = zipfile.ZipInfo(path, date)
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return f"{module}-{version}-{tag}.whl", buffer.getvalue()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("licenses", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--commit-time", type=int, required=True)
    arguments = parser.parse_args()
    time = arguments.commit_time
    version = output_of(arguments.program, "--version").decode().strip()
    tree = installed_files(arguments.program, arguments.licenses, time)
    arguments.output.mkdir(parents=True, exist_ok=True)
    sums = ""
    for make in (make_tarball, make_deb, make_image, make_wheel):
        name, content = make(tree, version, time)
        (arguments.output / name).write_bytes(content)
        sums += f"{hashlib.sha256(content).hexdigest()}  {name}\n"
        print(f"{len(content) / 1e6:5.1f} MB  {name}")
    (arguments.output / "SHA256SUMS").write_text(sums)


main()
