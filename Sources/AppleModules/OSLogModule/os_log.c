#include "os_log.h"
