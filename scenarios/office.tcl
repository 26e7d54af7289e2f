# The rounds of office.yaml as a script: the robot visits its goals one after another. If the way is blocked, what the
# laser has seen is marked on the map, and another route is planned.

connect
foreach module {rflex sick segloc pom ndd} { lm $module }

set tries_max 8

proc start_modules {} {
  set pose [waitpoint::start]
  rflex::SetPos $pose
  pom::SetPos $pose
  sick::ContinuousShot -async
  segloc::Localise -async $pose
  rflex::TrackSpeedStart -async
  # Until the laser and the position are there.
  while {[catch {pom::PosterRead position}] || [catch {sick::PosterRead echoes}]} { after 50 }
}

# Follows a route; false if the way is blocked. A request takes at most 48 points.
proc drive {route} {
  while {[llength $route] > 0} {
    set drive [ndd::GoTo -async [lrange $route 0 47]]
    set route [lrange $route 48 end]
    while 1 {
      try {
        wait -timeout 500 $drive
        break
      } trap {WAITPOINT TIMEOUT} {} {
        waitpoint::look
      } trap {WAITPOINT REPORT} {message} {
        puts $message
        return 0
      }
    }
  }
  return 1
}

proc visit {number goal} {
  dict with goal {
    for {set try 0} {$try < $::tries_max} {incr try} {
      if {[catch {waitpoint::plan $x $y} route]} {
        # The marks may have been those of something that moved on.
        waitpoint::forget
        if {[catch {waitpoint::plan $x $y} route]} { break }
      }
      if {[drive $route]} {
        waitpoint::reached $number
        puts "goal $number reached"
        return
      }
      waitpoint::mark
    }
  }
  waitpoint::missed $number
  puts "goal $number given up: $route"
}

start_modules
set number 0
foreach goal [waitpoint::goals] {
  visit $number $goal
  incr number
}
ndd::Stop
rflex::Stop
sick::Stop
