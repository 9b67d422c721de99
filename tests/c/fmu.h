/* The FMU in an unpacked folder, as an importer written in C sees it. */

#ifndef FMU_H
#define FMU_H

#include <stddef.h>

/* Types of FMI 2.0, written apart from the library under test. */
typedef void *Component;
typedef unsigned int Reference;
typedef int Status; /* 0 OK, 1 warning, 3 error */

enum { OK = 0, ERROR = 3, MODEL_EXCHANGE = 0, CO_SIMULATION = 1 };

typedef void (*Logger)(void *environment, const char *instance, Status status, const char *category,
                       const char *message, ...);

typedef struct {
    Logger logger;
    void *(*allocate_memory)(size_t, size_t);
    void (*free_memory)(void *);
    void (*step_finished)(void *, Status);
    void *environment;
} Callbacks;

typedef struct {
    void *library;
    const char *binary; /* its path */
    char *description; /* modelDescription.xml */
    char *guid;
    char *resources; /* a file: URI */
    Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int);
    void (*free_instance)(Component);
    Status (*setup_experiment)(Component, int, double, double, int, double);
    Status (*enter_initialization)(Component);
    Status (*exit_initialization)(Component);
    Status (*set_real)(Component, const Reference *, size_t, const double *);
    Status (*set_integer)(Component, const Reference *, size_t, const int *);
    Status (*set_boolean)(Component, const Reference *, size_t, const int *);
    Status (*get_real)(Component, const Reference *, size_t, double *);
    Status (*do_step)(Component, double, double, int);
    Status (*get_state)(Component, void **);
    Status (*set_state)(Component, void *);
    Status (*free_state)(Component, void **);
    Status (*serialized_size)(Component, void *, size_t *);
    Status (*serialize)(Component, void *, char *, size_t);
    Status (*deserialize)(Component, const char *, size_t, void **);
    Status (*enter_continuous_time)(Component);
    Status (*get_derivatives)(Component, double *, size_t);
    Status (*terminate)(Component);
} Fmu;

/* Prints a sentence and ends the process with 1. */
void fail(const char *sentence);

/* Reads modelDescription.xml in a folder, loads the shared library and finds its functions. */
void load(Fmu *fmu, const char *folder, const char *binary);

/* Unloads the library, of which nothing may stay in the process. */
void unload(Fmu *fmu);

/* The value reference of a variable by its name. */
Reference reference(const Fmu *fmu, const char *name);

/* Number of continuous states. */
size_t states(const Fmu *fmu);

/* An instance that logs to a counter of messages. */
Component instantiate(const Fmu *fmu, int kind, int *messages);

/* Fails if a call is not answered with OK. */
void ok(Status status, const char *call);

void set_real(const Fmu *fmu, Component instance, const char *name, double value);
void set_integer(const Fmu *fmu, Component instance, const char *name, int value);
void set_boolean(const Fmu *fmu, Component instance, const char *name, int value);

#endif
