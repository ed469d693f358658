//! Processor time: what work cost, however many others used the machine meanwhile.

use std::time::Duration;

/// Processor time of the calling thread so far; `None` where the system does not tell.
pub(crate) fn of_thread() -> Option<Duration> {
    read(Clock::Thread)
}

/// Processor time of all threads of this process so far; `None` where the system does not tell.
pub(crate) fn of_process() -> Option<Duration> {
    read(Clock::Process)
}

/// The time since an earlier reading of the same clock.
pub(crate) fn since(earlier: Option<Duration>, now: Option<Duration>) -> Option<Duration> {
    Some(now?.saturating_sub(earlier?))
}

enum Clock {
    Thread,
    Process,
}

#[cfg(unix)]
fn read(clock: Clock) -> Option<Duration> {
    use rustix::time::{ClockId, clock_gettime};
    let time = clock_gettime(match clock {
        Clock::Thread => ClockId::ThreadCPUTime,
        Clock::Process => ClockId::ProcessCPUTime,
    });
    Some(Duration::new(u64::try_from(time.tv_sec).ok()?, u32::try_from(time.tv_nsec).ok()?))
}

#[cfg(not(unix))]
fn read(_: Clock) -> Option<Duration> {
    None
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::time::Instant;

    #[test]
    fn sleep_costs_nothing_and_work_costs_its_time() {
        let asleep = of_thread();
        std::thread::sleep(Duration::from_millis(50));
        assert!(since(asleep, of_thread()).unwrap() < Duration::from_millis(25));

        let (started, thread, process) = (Instant::now(), of_thread(), of_process());
        while since(thread, of_thread()).unwrap() < Duration::from_millis(20) {}
        // A thread cannot be busy for longer than the clock on the wall says, nor its process for less time.
        let busy = since(thread, of_thread()).unwrap();
        assert!(since(process, of_process()).unwrap() + Duration::from_millis(1) >= busy);
        assert!(started.elapsed() + Duration::from_millis(1) >= busy);
    }
}
