import{C as e,S as t,a as n,b as r,d as i,l as a,m as o,o as s,p as c,r as l,s as u,u as d,x as f}from"./index-B5g3GHyC.js";import{t as p}from"./tab-BkMu52L1.js";import{t as m}from"./axis-picker-xQ5SLATQ.js";var h=1e3,g=[`pin`,`axis`,`port`,`way`,`bytes`],_={ms:`ms`,volts:`V`,at:`s`,duration:`s`,pulses:`pulses`,load:`of pull-out torque`,rate:`0 to 1`},v=class extends p{static properties={...p.properties,faults:{state:!0},kinds:{state:!0},kind:{state:!0},problem:{state:!0}};#e=0;static styles=[c,e`
      .fields {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(110px, 1fr));
        gap: 8px;
      }
      .about {
        font-size: 13px;
        color: var(--muted);
      }
    `];constructor(){super(),this.faults=[],this.kinds=[],this.kind=``,this.problem=null}connectedCallback(){super.connectedCallback(),this.#t()}disconnectedCallback(){super.disconnectedCallback(),clearTimeout(this.#e)}async#t(){if(clearTimeout(this.#e),this.active&&!document.hidden)try{this.kinds.length===0&&(this.kinds=await this.api.faultKinds(),this.kind||=this.kinds[0]?.name??``),this.faults=await this.api.faults(this.device.name),this.problem=null}catch(e){this.problem=o(e)}this.isConnected&&(this.#e=window.setTimeout(()=>void this.#t(),h))}render(){let e=this.kinds.find(({name:e})=>e===this.kind),{name:t}=this.device;return f`
      <section class="panel stack" aria-label="Power and faults">
        <div class="row"><h2 class="grow">Power</h2>
          <button class="small" ?disabled=${!this.usable} title="Off and on again"
            @click=${()=>d(()=>this.api.powerCycle(t),`Switched off and on`)}>Power cycle</button>
          <button class="small danger" ?disabled=${!this.usable} title="What flash had not finished is lost" @click=${this.#n}>Power cut</button>
        </div>
        <h2>Faults on purpose</h2>
        ${this.problem?f`<p class="error-text">${this.problem}</p>`:r}
        ${this.#r()}
        ${e?this.#a(e):r}
      </section>
    `}async#n(){await a({heading:`Cut the power?`,text:`The controller starts again at once; what its flash was writing is lost or torn.`,yes:`Cut`,danger:!0})&&await d(()=>this.api.powerCut(this.device.name),`Power cut`)}#r(){return this.faults.length===0?f`<p class="muted">There is none.</p>`:f`
      <table aria-label="Faults">
        <thead><tr><th>Fault</th><th>With</th><th>State</th>
          <th><button class="small plain" ?disabled=${!this.usable}
            @click=${()=>this.#i(()=>this.api.clearFaults(this.device.name))}>Clear all</button></th></tr></thead>
        <tbody>
          ${this.faults.map(e=>{let{id:t,kind:n,state:r,...i}=e,a=Object.entries(i).map(([e,t])=>`${e} ${typeof t==`object`?JSON.stringify(t):String(t)}`);return f`
              <tr><td>${y(String(n))}</td><td>${a.join(`, `)}</td>
                <td><span class="badge ${r===`active`?`error`:`warn`}">${r}</span></td>
                <td><button class="small" ?disabled=${!this.usable} aria-label="Clear ${y(String(n))}"
                  @click=${()=>this.#i(()=>this.api.clearFault(this.device.name,t))}>Clear</button></td></tr>`})}
        </tbody>
      </table>
    `}async#i(e){await d(e),await this.#t()}#a(e){let t=[`at`,...e.lasts?[`duration`]:[]];return f`
      <form class="stack" @submit=${this.#c}>
        <label>Kind
          <select @change=${e=>this.kind=e.target.value}>
            ${this.kinds.map(({name:e})=>f`<option value=${e} ?selected=${e===this.kind}>${y(e)}</option>`)}
          </select>
        </label>
        <p class="about">${e.text}</p>
        <div class="fields">
          ${e.needs.map(e=>this.#o(e,!0))} ${e.may.map(e=>this.#o(e,!1))}
          ${t.map(e=>this.#o(e,!1))}
        </div>
        <div class="row"><span class="grow"></span><button ?disabled=${!this.usable}>Add</button></div>
      </form>
    `}#o(e,t){let n=`${e===`at`?`begins in`:y(e)}${_[e]?` (${_[e]})`:``}`,i=this.#s(e);return i?f`<label>${n}<select name=${e}>
        ${t?r:f`<option value="">any</option>`}
        ${i.map(e=>f`<option>${e}</option>`)}</select></label>`:f`<label>${n}<input name=${e} type="text" class="number" autocomplete="off" ?required=${t} /></label>`}#s(e){switch(e){case`axis`:return this.catalog.axes;case`pin`:return this.catalog.pins.filter(({kind:e})=>e!==`output`&&e!==`analog_output`).map(({name:e})=>e);case`port`:return[`usb`,`rs485`,`can`];case`way`:return[`in`,`out`];case`value`:return[`true`,`false`];default:return null}}#c(e){e.preventDefault();let t={kind:this.kind};for(let[r,a]of new FormData(e.target)){let e=String(a).trim();if(e===``)continue;let o=g.includes(r)?e:r===`value`?e===`true`:n(e);if(o===null){i(`${y(r)}: “${e}” is not a number.`,`error`);return}t[r]=o}this.#i(()=>this.api.addFault(this.device.name,t))}};customElements.define(`pt-faults`,v);function y(e){return e.replaceAll(`_`,` `)}var b=[-100,-10,-1,1,10,100];function x(e){return e.parameters.some(({role:e})=>e===`pulser_enable`)}var S=class extends p{static properties={...p.properties,axis:{state:!0}};static styles=[c,e`
      .steps {
        display: grid;
        grid-template-columns: repeat(${b.length}, 1fr);
        gap: 6px;
      }
      button {
        padding: 3px 4px;
      }
      p {
        font-size: 13px;
      }
    `];willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.catalog.axes[0]??``)}render(){return f`
      <section class="panel stack" aria-label="Hand wheel">
        <div class="row"><h2 class="grow">Hand wheel</h2>
          ${m(this.catalog.axes,this.axis,`wheel-axis`,e=>this.axis=e)}
        </div>
        <p class="muted">Counts of the manual pulse generator; the axis follows where ${this.#e} is 1.</p>
        <div class="steps">
          ${b.map(e=>f`<button ?disabled=${!this.usable} @click=${()=>this.#t(e)}>
            ${e>0?`+${e}`:`−${-e}`}</button>`)}
        </div>
      </section>
    `}get#e(){return this.catalog.parameters.find(({role:e,axis:t})=>e===`pulser_enable`&&t===this.axis)?.id??``}#t(e){d(()=>this.api.turnPulser(this.device.name,this.axis,e))}};customElements.define(`pt-hand-wheel`,S);var C=60,w=class{#e;#t;#n;#r=null;#i=!1;constructor(e,t,n){this.#e=e,this.#t=t,this.#n=n}set(e){this.#r=e,this.#i||this.#a()}async#a(){this.#i=!0;let e;for(;e!==this.#r;){e=this.#r;let t=e;if(!await d(()=>t===null?this.#e.releasePin(this.#t,this.#n):this.#e.drivePin(this.#t,this.#n,t)))break;await new Promise(e=>window.setTimeout(e,C))}this.#i=!1}},T=56,E={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]};function D(e){return e.pins.filter(({kind:e,role:t,low:n,high:r})=>e===`analog`&&t===`joystick`&&n!==null&&r!==null).slice(0,2)}var O=class extends p{static properties={...p.properties,at:{state:!0}};#e=[];#t=!1;static styles=[c,e`
      svg {
        display: block;
        margin: 0 auto;
        touch-action: none;
        cursor: grab;
      }
      .field {
        fill: var(--raised);
        stroke: var(--strong-line);
      }
      .cross {
        stroke: var(--line);
      }
      .stick {
        fill: var(--accent);
      }
      p {
        font-size: 13px;
      }
    `];constructor(){super(),this.at=[0,0]}willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.#e=D(this.catalog).map(({name:e})=>new w(this.api,this.device.name,e)))}disconnectedCallback(){super.disconnectedCallback(),this.#o()}render(){let e=D(this.catalog),[t,n]=this.at;return f`
      <section class="panel stack" aria-label="Joystick">
        <h2>Joystick</h2>
        <p class="muted">${e.map(({name:e,axis:t})=>`${e}${t?` for ${t}`:``}`).join(`, `)}. It springs back; arrow keys bend it.</p>
        <svg width="150" height="150" viewBox="-75 -75 150 150" tabindex="0" role="application"
          aria-label="Joystick of ${e.map(({name:e})=>e).join(` and `)}"
          @pointerdown=${this.#n} @pointermove=${this.#r} @pointerup=${this.#o} @pointercancel=${this.#o}
          @keydown=${this.#i} @keyup=${this.#o} @blur=${this.#o}>
          <circle class="field" r="72" />
          <line class="cross" x1="-72" x2="72" /><line class="cross" y1="-72" y2="72" />
          <circle class="stick" r="15" cx=${t*T} cy=${-n*T} />
        </svg>
      </section>
    `}#n(e){e.button===0&&this.usable&&(e.currentTarget.setPointerCapture(e.pointerId),this.#t=!0,this.#r(e))}#r(e){if(!this.#t)return;let t=e.currentTarget.getBoundingClientRect(),n=(e.clientX-t.x-t.width/2)/T,r=-(e.clientY-t.y-t.height/2)/T,i=Math.max(1,Math.hypot(n,r));this.#a([n/i,r/i])}#i(e){let t=E[e.key];t&&this.usable&&(e.preventDefault(),this.#t=!0,e.repeat||this.#a(t))}#a(e){this.at=e,D(this.catalog).forEach(({low:t,high:n},r)=>{this.#e[r].set(Math.round((t+n)/2+e[r]*(n-t)/2))})}#o(){if(this.#t){this.#t=!1,this.at=[0,0];for(let e of this.#e)e.set(null)}}};customElements.define(`pt-joystick`,O);var k=class{#e;#t;#n;#r=!1;#i=Promise.resolve();constructor(e,t,n){this.#e=e,this.#t=t,this.#n=n}get pressed(){return this.#r}set(e){e!==this.#r&&(this.#r=e,this.#i=this.#i.then(()=>d(()=>e?this.#a():this.#o())))}async#a(){let e=await this.#e.pin(this.#t,this.#n);await this.#e.drivePin(this.#t,this.#n,e===!1||e===0)}#o(){return this.#e.releasePin(this.#t,this.#n)}},A=1.5,j=class extends p{static properties={...p.properties,axis:{type:String},load:{type:Number}};static styles=[c,e`
      :host {
        display: grid;
        grid-template-columns: minmax(180px, 1fr) auto;
        gap: 6px 18px;
        align-items: center;
      }
      .load {
        display: grid;
        grid-template-columns: auto 1fr 4em;
        gap: 8px;
        align-items: center;
        font-size: 13px;
      }
      output {
        text-align: right;
      }
      form input {
        width: 90px !important;
      }
      @media (max-width: 600px) {
        :host {
          grid-template-columns: 1fr;
        }
      }
    `];render(){return f`
      <div class="load">
        <label for="load">Load</label>
        <input id="load" type="range" min="0" max=${A} step="0.01" .value=${String(this.load)} ?disabled=${!this.usable}
          aria-label="Load of axis ${this.axis}" title="Part of the motor's pull-out torque; above 1 it stalls"
          @change=${e=>this.#e(Number(e.target.value))} />
        <output class=${this.load>1?`error-text`:``}>${Math.round(this.load*100)} %</output>
      </div>
      <form class="row" @submit=${this.#t}>
        <input name="pulses" class="number" type="text" inputmode="numeric" value="100" aria-label="Pulses, axis ${this.axis}" />
        <button class="small" value="push" ?disabled=${!this.usable} title="Turn the shaft by hand; less than 0 is backwards">Push</button>
        <button class="small" value="lose" ?disabled=${!this.usable} title="The motor does not follow its next pulses">Lose</button>
      </form>
    `}#e(e){d(()=>this.api.setLoad(this.device.name,this.axis,e))}#t(e){e.preventDefault();let t=s(String(new FormData(e.target).get(`pulses`))),n=e.submitter?.value===`lose`;if(t===null||n&&t<1){i(n?`So many pulses cannot be lost.`:`Pulses are a whole number.`,`error`);return}let{name:r}=this.device,{axis:a}=this;d(()=>n?this.api.lose(r,a,t):this.api.push(r,a,t),n?`The next ${t} pulses of ${a} are lost`:`${a} pushed by ${t}`)}};customElements.define(`pt-by-hand`,j);var M=46,N=1e4;function P(e,t){let n=[e.negative_limit,e.positive_limit,...e.home??[]].filter(e=>e!==null);if(e.negative_limit===null||e.positive_limit===null){let t=Math.round(e.shaft/N)*N;n.push(t-N,t+N)}let r=Math.min(...n,e.shaft),i=Math.max(...n,e.shaft),a=(t-92)/Math.max(1,i-r);return{margin:M,low:r,high:i,perPulse:a,x:e=>M+(e-r)*a,pulse:e=>r+(e-M)/a}}function F(e,t){let n=e.circumference;return(t%n+n)%n/n}function I(e,[t,n],r){let i=e=>{let t=e*2*Math.PI;return`${(Math.sin(t)*r).toFixed(2)} ${(-Math.cos(t)*r).toFixed(2)}`},a=Math.min(.999,Math.max((n-t)/e.circumference,.01)),o=F(e,t);return`M ${i(o)} A ${r} ${r} 0 ${+(a>.5)} 1 ${i(o+a)}`}function L({home:e,negative_limit:t,positive_limit:n},r){switch(r){case`negative limit`:return t;case`positive limit`:return n;case`home`:return e&&(e[0]+e[1])/2}}function R(e,t,n){let r=Math.round(e.circumference===null?n:F(e,n)*e.circumference);switch(t){case`negative limit`:return{negative_limit:r};case`positive limit`:return{positive_limit:r};case`home`:{let t=e.home[1]-e.home[0],n=r-Math.floor(t/2);return{home:[n,n+t]}}}}function z(e,t){let{shaft:n,home:r,negative_limit:i,positive_limit:a}=e;switch(t){case`negative limit`:return i!==null&&n<=i;case`positive limit`:return a!==null&&n>=a;case`home`:return r===null?!1:e.circumference===null?r[0]<=n&&n<=r[1]:(F(e,n)-F(e,r[0])+1)%1<=(r[1]-r[0])/e.circumference}}function B(e,t,n){let r=e.home?Math.max(1,(e.home[1]-e.home[0])/2):1;if(e.circumference!==null){let t=Math.abs(F(e,n)-F(e,e.shaft)),i=Math.max(r/e.circumference,.01);return Math.min(t,1-t)<=i}if(t===`negative limit`)return e.shaft<=n;if(t===`positive limit`)return e.shaft>=n;let i=(e.positive_limit??0)-(e.negative_limit??0);return Math.abs(e.shaft-n)<=Math.max(r,i/100)}var V=e`
  .axis + .axis {
    margin-top: 10px;
    padding-top: 10px;
    border-top: 1px solid var(--line);
  }
  .head {
    font-size: 13px;
  }
  svg {
    display: block;
    width: 100%;
    font-size: 11px;
    font-variant-numeric: tabular-nums;
    touch-action: pan-y;
  }
  text {
    fill: var(--muted);
  }
  .rail {
    stroke: var(--strong-line);
    stroke-width: 4;
    stroke-linecap: round;
    fill: none;
  }
  .mark {
    stroke: var(--line);
    stroke-width: 1.5;
  }
  .home {
    fill: var(--ok);
    opacity: 0.75;
  }
  .home-arc {
    stroke: var(--ok);
    stroke-width: 6;
    fill: none;
  }
  .carriage {
    fill: var(--accent);
  }
  .slack {
    fill: var(--accent);
    opacity: 0.25;
  }
  .hand {
    stroke: var(--accent);
    stroke-width: 4;
    stroke-linecap: round;
  }
  .switch {
    cursor: grab;
    touch-action: none;
    user-select: none;
    outline: none;
  }
  .switch .body {
    fill: var(--panel);
    stroke: var(--strong-line);
    stroke-width: 2;
  }
  .switch text {
    fill: var(--text);
    font-weight: 650;
    text-anchor: middle;
  }
  .switch.on .body {
    fill: var(--ok);
    stroke: var(--ok);
  }
  .switch.on.limit .body {
    fill: var(--error);
    stroke: var(--error);
  }
  .switch.on .body + text {
    fill: var(--panel);
  }
  .hit {
    fill: transparent;
  }
  .switch:focus-visible .body {
    stroke: var(--accent);
    stroke-width: 3;
  }
`,H=80,U=.35,W=88,G=38,K=172,q=48,J=5,Y=[`negative limit`,`home`,`positive limit`],X={"negative limit":`−L`,home:`H`,"positive limit":`+L`},Z=class extends p{static properties={...p.properties,machine:{state:!0},width:{state:!0},drag:{state:!0},problem:{state:!0},mounting:{state:!0}};watches=[`status`];#e=0;#t=0;#n=new Map;#r=new ResizeObserver(([e])=>{e&&e.contentRect.width>0&&(this.width=e.contentRect.width)});static styles=[c,V];constructor(){super(),this.machine=null,this.width=600,this.drag=null,this.problem=null,this.mounting=!1}connectedCallback(){super.connectedCallback(),this.#i(),this.#o()}disconnectedCallback(){super.disconnectedCallback(),clearTimeout(this.#e),cancelAnimationFrame(this.#t),this.#r.disconnect(),this.#S()}firstUpdated(){this.#r.observe(this)}async#i(){if(this.active&&!document.hidden)try{this.machine=await this.api.machine(this.device.name),this.problem=null,this.#a()}catch(e){this.problem=o(e)}this.isConnected&&(this.#e=window.setTimeout(()=>void this.#i(),this.problem?1e3:H))}#a(){let{drag:e}=this,t=e&&this.machine?.axes[e.axis];e?.press&&t&&e.press.set(B(t,e.role,e.at)!==z(t,e.role))}#o(){this.#t=requestAnimationFrame(()=>{if(this.#o(),this.active&&this.machine)for(let[e,t]of Object.entries(this.machine.axes)){let n=this.#n.get(e)??t.shaft,r=t.shaft-n,i=Math.abs(r)<.5?t.shaft:n+r*U;this.#n.set(e,i),this.renderRoot.querySelector(`[data-shaft="${e}"]`)?.setAttribute(`transform`,this.#s(t,i))}})}#s(e,t){return e.circumference===null?`translate(${P(e,this.width).x(t).toFixed(2)} 0)`:`rotate(${(F(e,t)*360).toFixed(2)})`}render(){return this.machine?f`
      <section class="panel stack" aria-label="Machine">
        <div class="row"><h2>Machine</h2>
          <span class="muted grow">${this.mounting?`Drag a switch to where it is to be, or move it with the arrow keys; with Shift in small steps.`:`Drag a switch to the carriage to press it, or hold the space bar on it.`}</span>
          <button class="small" aria-pressed=${this.mounting} ?disabled=${!this.usable}
            @click=${()=>this.mounting=!this.mounting}>Move switches</button>
        </div>
        <div>
          ${this.#c().map(([e,t])=>f`
            <div class="axis">
              <div class="row head"><strong>${e}</strong>
                <span class="muted">shaft ${l(t.shaft)} · counter ${l(this.live.status?.axes[e]?.position)}
                  ${t.index_every?`· an index mark every ${l(t.index_every)}`:r}
                  ${t.backlash?`· backlash ${l(t.backlash)}`:r}</span>
              </div>
              ${t.circumference===null?this.#l(e,t):this.#d(e,t)}
              <pt-by-hand .axis=${e} .load=${t.load} ${this.given()}></pt-by-hand>
            </div>`)}
        </div>
      </section>
    `:f`<section class="panel"><h2>Machine</h2>
        <p class=${this.problem?`error-text`:`muted`}>${this.problem??`Loading…`}</p></section>`}#c(){return this.catalog.axes.flatMap(e=>{let t=this.machine?.axes[e];return t?[[e,t]]:[]})}#l(e,n){let i=P(n,this.width),a=n.backlash*i.perPulse;return f`
      <svg viewBox="0 0 ${this.width} ${W}" height=${W} role="group"
        aria-label="Stage of axis ${e}, from ${n.negative_limit??`no limit`} to ${n.positive_limit??`no limit`}">
        <line class="rail" x1=${i.margin} x2=${this.width-i.margin} y1=${G} y2=${G} />
        ${this.#u(n,i)}
        ${n.home?t`<rect class="home" x=${i.x(n.home[0])} y=${35} height="6" rx="1"
              width=${Math.max(3,i.x(n.home[1])-i.x(n.home[0]))} />`:r}
        <g data-shaft=${e} transform=${this.#s(n,this.#n.get(e)??n.shaft)}>
          ${a>=1?t`<rect class="slack" x=${-14-a/2} y=${8} width=${28+a} height="24" rx="4" />`:r}
          <rect class="carriage" x="-14" y=${8} width="28" height="24" rx="4" />
          <path class="carriage" d="M -5 ${31} L 5 ${31} L 0 ${37} Z" />
        </g>
        ${Y.map(t=>this.#f(e,n,t,i))}
      </svg>
    `}#u(e,n){let i=e.index_every;if(!i||i*n.perPulse<J)return r;let a=Math.ceil(n.low/i),o=Math.floor(n.high/i)-a+1;return Array.from({length:o},(e,r)=>{let o=n.x((a+r)*i);return t`<line class="mark" x1=${o} x2=${o} y1=${42} y2=${48} />`})}#d(e,n){let{width:i}=this,a=n.index_every??0,o=a>0?Math.min(360,Math.floor(n.circumference/a)):0;return f`
      <svg viewBox="${-i/2} ${-86} ${i} ${K}" height=${K} role="group"
        aria-label="Shaft of axis ${e}, ${n.circumference} to the turn">
        <circle class="rail" r=${q} />
        ${Array.from({length:o},(e,r)=>t`<line class="mark" transform="rotate(${F(n,r*a)*360})" y1=${-43} y2=${-37} />`)}
        ${n.home?t`<path class="home-arc" d=${I(n,n.home,q)} />`:r}
        <g data-shaft=${e} transform=${this.#s(n,this.#n.get(e)??n.shaft)}>
          <line class="hand" y1="8" y2=${-41} /><circle class="carriage" r="7" />
        </g>
        ${Y.map(t=>this.#p(e,n,t))}
        <text x=${92} y="4">${l(n.circumference)} a turn</text>
      </svg>
    `}#f(e,n,i,a){let o=L(n,i);if(o===null||!this.#_(e,i))return r;let s=a.x(this.#g(e,i)??o);return this.#m(e,i,`translate(${s} 62)`,e=>a.pulse(this.#h(e)),t`
      <path class="body" d="M 0 -20 L 5 -12 L 15 -12 L 15 10 L -15 10 L -15 -12 L -5 -12 Z" />
      <text y="4">${X[i]}</text>`,t`<text y="24">${l(this.mounting?Math.round(this.#g(e,i)??o):o)}</text>`)}#p(e,n,i){let a=L(n,i);if(a===null||!this.#_(e,i))return r;let o=F(n,this.#g(e,i)??a)*2*Math.PI,s=`translate(${Math.sin(o)*66} ${-Math.cos(o)*66})`;return this.#m(e,i,s,e=>{let t=e.currentTarget.ownerSVGElement.getBoundingClientRect();return Math.atan2(e.clientX-t.x-t.width/2,-(e.clientY-t.y-t.height/2))/(2*Math.PI)*n.circumference},t`<circle class="body" r="12" /><text y="4">${X[i]}</text>`,r)}#m(e,n,r,i,a,o){let s=this.#v(e,n),c=t=>{this.mounting?t.type===`keydown`&&this.#C(t,e,n):(t.key===` `||t.key===`Enter`)&&(t.preventDefault(),t.repeat||(t.type===`keydown`?this.#x(e,n):this.#S()))};return t`
      <g class="switch ${s?`on`:``} ${n===`home`?``:`limit`}" transform=${r} tabindex="0" role="button"
        aria-label="${n} switch of ${e}, ${s?`on`:`off`}" aria-pressed=${s?`true`:`false`}
        @pointerdown=${t=>this.#y(t,e,n,i(t))}
        @pointermove=${t=>this.#b(e,n,()=>i(t))}
        @pointerup=${()=>this.#S()} @pointercancel=${()=>this.#S()} @lostpointercapture=${()=>this.#S()}
        @keydown=${c} @keyup=${c} @blur=${()=>this.#S()}>
        <rect class="hit" x="-23" y="-20" width="46" height="46" />${a} ${o}
      </g>
    `}#h(e){return e.clientX-e.currentTarget.ownerSVGElement.getBoundingClientRect().x}#g(e,t){let{drag:n}=this;return n?.axis===e&&n.role===t?n.at:null}#_(e,t){return this.catalog.pins.find(n=>n.axis===e&&n.role===t)?.name??null}#v(e,t){let n=this.live.status?.axes[e];return{"negative limit":n?.negative_limit,"positive limit":n?.positive_limit,home:n?.home}[t]??!1}#y(e,t,n,r){let i=this.#_(t,n);e.button===0&&i&&this.usable&&(e.currentTarget.setPointerCapture(e.pointerId),this.drag={axis:t,role:n,at:r,press:this.mounting?null:new k(this.api,this.device.name,i)},this.#a())}#b(e,t,n){this.#g(e,t)!==null&&(this.drag={...this.drag,at:n()},this.#a())}#x(e,t){let n=this.#_(e,t),r=this.machine?.axes[e]?.shaft;n&&r!==void 0&&this.usable&&(this.drag={axis:e,role:t,at:r,press:new k(this.api,this.device.name,n)},this.#a())}#S(){let{drag:e}=this;this.drag=null,e?.press?e.press.set(!1):e&&this.#w(e.axis,e.role,e.at)}#C(e,t,n){let r=this.machine?.axes[t],i=r&&L(r,n),a={ArrowLeft:-1,ArrowDown:-1,ArrowRight:1,ArrowUp:1}[e.key];if(!r||i==null||a===void 0||!this.usable)return;e.preventDefault();let{low:o,high:s}=P(r,this.width),c=(r.circumference??s-o)/(e.shiftKey?1e4:100);this.#w(t,n,i+a*Math.max(1,Math.round(c)))}async#w(e,t,n){let r=this.machine?.axes[e];r&&(await d(()=>this.api.moveSwitches(this.device.name,{axis:e,...R(r,t,n)})),this.machine=await this.api.machine(this.device.name).catch(()=>this.machine))}};customElements.define(`pt-machine`,Z);var Q=class extends p{static properties={...p.properties,keep:{state:!0},driven:{state:!0}};watches=[`status`];#e=new Map;#t=new Map;static styles=[c,e`
      .tiles {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(104px, 1fr));
        gap: 6px;
      }
      .tile {
        display: flex;
        align-items: center;
        justify-content: flex-start;
        gap: 7px;
        min-height: 34px;
        padding: 2px 9px;
        border: 1px solid var(--line);
        border-radius: var(--radius);
        background: var(--raised);
        overflow: hidden;
        text-align: left;
        touch-action: none;
      }
      button.tile {
        border-color: var(--strong-line);
      }
      .tile i {
        flex: none;
        width: 11px;
        height: 11px;
        border: 2px solid var(--strong-line);
        border-radius: 50%;
      }
      .tile.on i {
        border-color: var(--ok);
        background: var(--ok);
      }
      .tile.on {
        font-weight: 650;
      }
      .tile.driven {
        border-color: var(--accent);
        box-shadow: inset 0 0 0 1px var(--accent);
      }
      .tile small {
        display: block;
        color: var(--muted);
        font-weight: 400;
        font-size: 11px;
        line-height: 12px;
      }
      .tile span {
        line-height: 16px;
      }
      .analog {
        display: grid;
        grid-template-columns: auto minmax(60px, 1fr) auto 34px;
        gap: 6px 10px;
        align-items: center;
      }
      .analog input {
        width: 100%;
        min-width: 0;
      }
      .analog output {
        min-width: 5em;
        text-align: right;
      }
      .sub {
        margin: 2px 0 4px;
      }
    `];constructor(){super(),this.keep=!1,this.driven=new Map}disconnectedCallback(){super.disconnectedCallback();for(let e of this.#e.values())e.set(!1)}get#n(){return this.device.kind===`virtual`}render(){let{pins:e}=this.catalog,t=this.live.status?.outputs??{},n=e=>e.kind===`output`||e.kind===`port`&&e.name in t,i=e.filter(e=>[`input`,`index`,`port`].includes(e.kind)&&!n(e)),a=e.filter(e=>e.kind===`analog`),o=e.filter(e=>e.kind===`analog_output`);return f`
      <section class="panel stack" aria-label="Inputs and outputs">
        <div class="row"><h2 class="grow">Inputs</h2>
          ${this.#n?f`<label class="line" title="A click presses, another one lets go">
                <input type="checkbox" .checked=${this.keep} @change=${e=>this.keep=e.target.checked} />
                keep pressed</label>`:r}
        </div>
        ${this.#r(i)}
        <h2>Outputs</h2>
        <div class="tiles">${e.filter(n).map(e=>this.#c(e))}</div>
        ${a.length+o.length>0?f`<h2>Analog</h2>
              <div class="analog">${a.map(e=>this.#l(e))} ${o.map(e=>this.#p(e))}</div>`:r}
      </section>
    `}#r(e){return[null,...this.catalog.axes].map(t=>{let n=e.filter(e=>this.#i(e)===t);return n.length===0?r:f`
        <div>
          ${t===null?r:f`<h3 class="sub">Axis ${t}</h3>`}
          <div class="tiles">${n.map(e=>this.#o(e))}</div>
        </div>
      `})}#i({axis:e,name:t,kind:n}){if(e!==null)return e;let r=t.at(-1)??``;return n===`input`&&/[A-Z]/.test(r)&&t.length>3&&this.catalog.axes.includes(r)?r:null}#a(e){let t=this.live.status?.inputs[e.name];if(t!==void 0)return t===!0||typeof t==`number`&&t!==0;let n=e.axis===null?void 0:this.live.status?.axes[e.axis];if(!n)return null;switch(e.role){case`negative limit`:return n.negative_limit;case`positive limit`:return n.positive_limit;case`home`:return n.home;case`index`:return n.index;default:return null}}#o(e){let t=this.#a(e),n=this.#e.get(e.name),i=`${e.name}${e.role?`, ${e.role}`:``}${t===null?``:t?`, on`:`, off`}`,a=f`<i></i><span>${e.name} ${e.role?f`<small>${e.role}</small>`:r}</span>`,o=`tile ${t?`on`:``} ${n?.pressed?`driven`:``}`;if(!this.#n)return f`<div class=${o} role="img" aria-label=${i} title=${i}>${a}</div>`;let s=()=>{this.keep||this.#s(e.name,!1)};return f`
      <button class=${o} title=${i} aria-label=${i} aria-pressed=${n?.pressed??!1} ?disabled=${!this.usable}
        @pointerdown=${t=>{t.button===0&&(this.keep||t.currentTarget.setPointerCapture(t.pointerId),this.#s(e.name,!this.keep||!n?.pressed))}}
        @pointerup=${s} @pointercancel=${s} @blur=${s} @contextmenu=${e=>e.preventDefault()}
        @keydown=${t=>{t.repeat||t.key!==` `&&t.key!==`Enter`||(t.preventDefault(),this.#s(e.name,!this.keep||!n?.pressed))}}
        @keyup=${s}>${a}</button>
    `}#s(e,t){let n=this.#e.get(e)??new k(this.api,this.device.name,e);this.#e.set(e,n),n.set(t),this.requestUpdate()}#c(e){let t=this.live.status?.outputs[e.name],n=t===!0||typeof t==`number`&&t!==0,i=t!==void 0&&this.catalog.actions.includes(`output`);return f`
      <button class="tile ${n?`on`:``}" role="switch" aria-checked=${n} ?disabled=${!this.usable||!i}
        title="${e.name}${e.role?`, ${e.role}`:``}: ${i?n?`on`:`off`:`cannot be set from here`}"
        @click=${()=>d(()=>this.api.act(this.device.name,{do:`output`,name:e.name,value:!n}))}>
        <i></i><span>${e.name} ${e.role?f`<small>${e.role}</small>`:r}</span>
      </button>
    `}#l(e){let t=this.live.status?.inputs[e.name],n=typeof t==`number`?t:this.driven.get(e.name)??null,r=this.#n&&e.low!==null&&e.high!==null;return f`
      <span>${e.name} <small class="muted">${e.role}</small></span>
      ${r?f`<input type="range" min=${e.low} max=${e.high} step=${e.high-e.low>200?1:.1} ?disabled=${!this.usable}
            aria-label="${e.name}${e.role?`, ${e.role}`:``}" .value=${String(this.driven.get(e.name)??n??e.low)}
            @input=${t=>this.#u(e.name,Number(t.target.value))} />`:f`<span></span>`}
      <output>${u(n)} ${e.unit}</output>
      ${r?f`<button class="small plain" ?disabled=${!this.driven.has(e.name)} title="Give it back to the machine"
            aria-label="Give ${e.name} back to the machine" @click=${()=>this.#d(e.name)}>✕</button>`:f`<span></span>`}
    `}#u(e,t){this.driven=new Map(this.driven).set(e,t),this.#f(e).set(t)}#d(e){let t=new Map(this.driven);t.delete(e),this.driven=t,this.#f(e).set(null)}#f(e){let t=this.#t.get(e)??new w(this.api,this.device.name,e);return this.#t.set(e,t),t}#p(e){let t=this.live.status?.outputs[e.name],n=typeof t==`number`?t:null;return f`
      <span>${e.name} <small class="muted">${e.role}</small></span>
      <input type="range" min=${e.low??0} max=${e.high??100} step="1" aria-label=${e.name} ?disabled=${!this.usable}
        .value=${String(n??0)}
        @change=${t=>d(()=>this.api.act(this.device.name,{do:`output`,name:e.name,value:Number(t.target.value)}))} />
      <output>${u(n)} ${e.unit}</output><span></span>
    `}};customElements.define(`pt-pins`,Q);var $=class extends p{static styles=[c,e`
      :host {
        display: grid;
        grid-template-columns: repeat(2, minmax(0, 1fr));
        gap: var(--gap);
        align-items: start;
      }
      .wide {
        grid-column: 1 / -1;
      }
      @media (max-width: 900px) {
        :host {
          grid-template-columns: minmax(0, 1fr);
        }
      }
    `];render(){let e=this.device.kind===`virtual`;return f`
      ${e?f`<pt-machine class="wide" ${this.given()}></pt-machine>`:r}
      <pt-pins class=${e?``:`wide`} ${this.given()}></pt-pins>
      ${e?f`<div class="stack">
            <pt-faults ${this.given()}></pt-faults>
            ${D(this.catalog).length>0?f`<pt-joystick ${this.given()}></pt-joystick>`:r}
            ${x(this.catalog)?f`<pt-hand-wheel ${this.given()}></pt-hand-wheel>`:r}
          </div>`:r}
    `}};customElements.define(`pt-io`,$);