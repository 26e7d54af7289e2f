#pragma once
#define FCL_EXPORT
#define FCL_NO_EXPORT
#define FCL_DEPRECATED __attribute__((__deprecated__))
#define FCL_DEPRECATED_EXPORT FCL_DEPRECATED
