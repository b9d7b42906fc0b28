// Look-ups of users and groups from /etc/passwd and /etc/group alone.
//
// Those of a static glibc load the system's NSS modules, which belong to another version of glibc:
// on Debian 13 with `passwd: files extrausers`, a user who is not in /etc/passwd ends the process
// with SIGFPE. Foundation looks up the home folder and the owners of files; a user who is not found
// has HOME, or none.
#define _GNU_SOURCE
#include <errno.h>
#include <grp.h>
#include <pwd.h>
#include <stdio.h>
#include <string.h>

static int find_user(const char *name, uid_t id, struct passwd *user, char *buffer, size_t size,
                     struct passwd **result) {
  *result = NULL;
  FILE *file = fopen("/etc/passwd", "re");
  if (!file) return errno == ENOENT ? 0 : errno;
  int error;
  struct passwd *found;
  while ((error = fgetpwent_r(file, user, buffer, size, &found)) == 0) {
    if (name ? strcmp(found->pw_name, name) == 0 : found->pw_uid == id) {
      *result = found;
      break;
    }
  }
  fclose(file);
  return error == ENOENT ? 0 : error;
}

static int find_group(const char *name, gid_t id, struct group *group, char *buffer, size_t size,
                      struct group **result) {
  *result = NULL;
  FILE *file = fopen("/etc/group", "re");
  if (!file) return errno == ENOENT ? 0 : errno;
  int error;
  struct group *found;
  while ((error = fgetgrent_r(file, group, buffer, size, &found)) == 0) {
    if (name ? strcmp(found->gr_name, name) == 0 : found->gr_gid == id) {
      *result = found;
      break;
    }
  }
  fclose(file);
  return error == ENOENT ? 0 : error;
}

int getpwnam_r(const char *name, struct passwd *user, char *buffer, size_t size,
               struct passwd **result) {
  return find_user(name, 0, user, buffer, size, result);
}

int getpwuid_r(uid_t id, struct passwd *user, char *buffer, size_t size, struct passwd **result) {
  return find_user(NULL, id, user, buffer, size, result);
}

int getgrnam_r(const char *name, struct group *group, char *buffer, size_t size,
               struct group **result) {
  return find_group(name, 0, group, buffer, size, result);
}

int getgrgid_r(gid_t id, struct group *group, char *buffer, size_t size, struct group **result) {
  return find_group(NULL, id, group, buffer, size, result);
}

// The variants without a buffer have one of their own, as in glibc; they are not thread-safe there
// either.
static char buffer[16384];

struct passwd *getpwnam(const char *name) {
  static struct passwd user;
  struct passwd *result;
  int error = getpwnam_r(name, &user, buffer, sizeof buffer, &result);
  if (error) errno = error;
  return result;
}

struct passwd *getpwuid(uid_t id) {
  static struct passwd user;
  struct passwd *result;
  int error = getpwuid_r(id, &user, buffer, sizeof buffer, &result);
  if (error) errno = error;
  return result;
}

struct group *getgrnam(const char *name) {
  static struct group group;
  struct group *result;
  int error = getgrnam_r(name, &group, buffer, sizeof buffer, &result);
  if (error) errno = error;
  return result;
}

struct group *getgrgid(gid_t id) {
  static struct group group;
  struct group *result;
  int error = getgrgid_r(id, &group, buffer, sizeof buffer, &result);
  if (error) errno = error;
  return result;
}
