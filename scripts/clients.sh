# Sourced by scripts/test-client and scripts/test-examples: makes this package a dependency by git
# URL and version, and builds packages that depend on it. They share a scratch folder, in which the
# engine is built once.
# shellcheck shell=bash

clients=$PWD/.build/clients
scratch=$clients/build

# Commits the working tree to a new git repository, tagged with the version of the package; sets url
# and version.
publish() {
  local repository=$clients/photogrammetry-cli.git checkout=$scratch/checkouts/photogrammetry-cli
  local git=(git --git-dir="$repository" --work-tree=. -c user.name=test -c user.email=
    -c commit.gpgSign=false -c tag.gpgSign=false)
  url=file://$repository
  version=$(grep -oE '[0-9]+\.[0-9]+\.[0-9]+' Sources/SceneModel/ProgramVersion.swift | head -n 1)

  # SwiftPM assumes that tags are immutable and records their revisions in the security folder.
  rm -rf "$repository" "$clients/security"
  git init --quiet --bare "$repository"
  "${git[@]}" add --all
  "${git[@]}" commit --quiet --message=Publish
  "${git[@]}" tag "$version"
  # Git updates an earlier checkout file by file, so that only changed sources are compiled again.
  [[ ! -d $checkout ]] || {
    git -C "$checkout" fetch --quiet "$url" HEAD
    git -C "$checkout" update-index -q --refresh # SwiftPM has changed the files' modes.
    git -C "$checkout" checkout --quiet --force --detach FETCH_HEAD
  }
}

# Builds the package in the folder $1, with the mirrors that scripts/setup has written. All files
# that persist are in .build.
build_client() {
  swift build -c release --package-path "$1" --scratch-path "$scratch" \
    --config-path .swiftpm/configuration --security-path "$clients/security" \
    --disable-dependency-cache
}

# Makes the package in the folder $1 depend on the published version instead of on a path.
depend_by_version() {
  local dependency=".package(url: \"$url\", from: \"$version\")"
  sed -i -E "s|\.package\(name: \"photogrammetry-cli\", path: \"[./]+\"\)|$dependency|" \
    "$1/Package.swift"
  grep -qF "$url" "$1/Package.swift"
}
