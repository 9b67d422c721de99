//! Running other programs: with a time limit, and so that nothing of them runs on after an error
//! or Ctrl-C.

use crate::{Failure, failed, stop};
use std::{
    io::{BufRead, BufReader, Read},
    process::{Child, Command, ExitStatus, Stdio},
    sync::mpsc::{self, RecvTimeoutError, Sender},
    thread,
    time::{Duration, Instant},
};

/// How long the last line of a program that has ended may take to arrive.
const LAST_LINES: Duration = Duration::from_millis(500);

/// How often a waiting program looks for Ctrl-C and at the clock.
pub const TICK: Duration = Duration::from_millis(50);

/// How long a program may take to clean up when it is asked to end.
#[cfg(unix)]
const GRACE: Duration = Duration::from_secs(5);

/// Runs a command. `each_line` gets its standard output while it runs. The result is the exit
/// status and, if the command's standard error is piped, what it has written there.
///
/// Fails, and ends the command and all that it has started, if it takes longer than `limit`, after
/// Ctrl-C, and if `each_line` fails.
pub fn run(
    command: &mut Command,
    limit: Duration,
    mut each_line: impl FnMut(&str) -> Result<(), Failure>,
) -> Result<(ExitStatus, String), Failure> {
    stop::check()?;
    let deadline = Instant::now() + limit;
    let mut running = Running::start(command)?;
    let (lines, received) = mpsc::channel();
    if let Some(output) = running.child.stdout.take() {
        send_lines(output, Line::Output, lines.clone());
    }
    if let Some(errors) = running.child.stderr.take() {
        send_lines(errors, Line::Error, lines.clone());
    }
    drop(lines);

    let mut errors = String::new();
    loop {
        let line = received.recv_timeout(TICK);
        stop::check()?;
        if Instant::now() > deadline {
            return Err(Failure(format!(
                "it did not end within {} and was stopped",
                in_words(limit)
            )));
        }
        match line {
            Ok(Line::Output(line)) => each_line(&line)?,
            Ok(Line::Error(line)) => errors += &format!("{line}\n"),
            Err(reason) => {
                if let Some(status) = running.status()? {
                    // Lines may still be on their way, or a program that it has started holds the
                    // pipe.
                    while let Ok(line) = received.recv_timeout(LAST_LINES) {
                        match line {
                            Line::Output(line) => each_line(&line)?,
                            Line::Error(line) => errors += &format!("{line}\n"),
                        }
                    }
                    return Ok((status, errors.trim_end().to_owned()));
                }
                if reason == RecvTimeoutError::Disconnected {
                    thread::sleep(TICK);
                }
            }
        }
    }
}

/// Runs a command. The result is the exit status, what it has written to its standard output and,
/// if that is piped, to its standard error.
pub fn output(
    command: &mut Command,
    limit: Duration,
) -> Result<(ExitStatus, String, String), Failure> {
    let mut output = String::new();
    let (status, errors) = run(command, limit, |line| {
        output += &format!("{line}\n");
        Ok(())
    })?;
    Ok((status, output, errors))
}

/// Runs a command whose output is only of interest if it fails: it is then in the error.
pub fn run_quietly(command: &mut Command, limit: Duration) -> Result<(), Failure> {
    let (status, output, errors) = output(command.stderr(Stdio::piped()), limit)?;
    if status.success() {
        return Ok(());
    }
    Err(Failure(format!("{status}\n{}", (output + &errors).trim())))
}

enum Line {
    Output(String),
    Error(String),
}

/// Sends the lines of a pipe from a thread of its own: a pipe that nobody reads stops its writer.
fn send_lines(pipe: impl Read + Send + 'static, kind: fn(String) -> Line, lines: Sender<Line>) {
    thread::spawn(move || {
        for line in BufReader::new(pipe).split(b'\n').map_while(Result::ok) {
            let text = String::from_utf8_lossy(&line);
            if lines.send(kind(text.trim_end().to_owned())).is_err() {
                break;
            }
        }
    });
}

/// A started program, which is ended when this is dropped.
struct Running {
    child: Child,
    has_ended: bool,
}

impl Running {
    fn start(command: &mut Command) -> Result<Running, Failure> {
        // In a group of its own it can be ended with all that it has started.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(command, 0);
        let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
        Ok(Running {
            child: child.map_err(failed("it cannot be started"))?,
            has_ended: false,
        })
    }

    /// The exit status, once it has ended.
    fn status(&mut self) -> Result<Option<ExitStatus>, Failure> {
        let status = self.child.try_wait().map_err(failed("its end is lost"))?;
        self.has_ended |= status.is_some();
        Ok(status)
    }

    #[cfg(unix)]
    fn signal_group(&self, signal: rustix::process::Signal) {
        if let Ok(id) = i32::try_from(self.child.id())
            && let Some(group) = rustix::process::Pid::from_raw(id)
        {
            // The group may have ended meanwhile.
            let _ = rustix::process::kill_process_group(group, signal);
        }
    }

    /// Asks the program to end as Ctrl-C does, and ends it if it does not.
    fn end(&mut self) {
        #[cfg(unix)]
        {
            self.signal_group(rustix::process::Signal::INT);
            let deadline = Instant::now() + GRACE;
            while matches!(self.child.try_wait(), Ok(None)) && Instant::now() < deadline {
                thread::sleep(TICK);
            }
            self.signal_group(rustix::process::Signal::KILL);
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if !self.has_ended {
            self.end();
        }
    }
}

fn in_words(limit: Duration) -> String {
    match limit.as_secs() {
        seconds @ 0..120 => format!("{seconds} s"),
        seconds => format!("{} min", seconds / 60),
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::io::pipe;

    #[test]
    fn a_program_that_takes_too_long_is_ended_with_all_that_it_has_started() {
        let (mut reader, writer) = pipe().unwrap();
        let mut command = Command::new("sh");
        command.args(["-c", "sleep 60 & wait"]).stderr(writer);
        let start = Instant::now();
        let failure = run(&mut command, Duration::from_secs(1), |_| Ok(()));
        assert_eq!(
            failure.unwrap_err().0,
            "it did not end within 1 s and was stopped"
        );
        drop(command);
        // The pipe ends when the last process that has it has ended: long before its 60 s, however
        // busy the machine is.
        reader.read_to_end(&mut Vec::new()).unwrap();
        assert!(start.elapsed() < Duration::from_secs(50));
    }

    #[test]
    fn what_a_program_writes_arrives_whole() {
        let mut command = Command::new("sh");
        command.args(["-c", "echo one; echo two >&2; printf three; exit 7"]);
        let (status, output, errors) =
            output(command.stderr(Stdio::piped()), Duration::from_secs(60)).unwrap();
        assert_eq!(status.code(), Some(7));
        assert_eq!((&*output, &*errors), ("one\nthree\n", "two"));
    }

    #[test]
    fn limits_are_read_as_seconds_or_minutes() {
        assert_eq!(in_words(Duration::from_secs(20)), "20 s");
        assert_eq!(in_words(Duration::from_secs(7200)), "120 min");
    }
}
